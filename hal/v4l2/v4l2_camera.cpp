// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/v4l2_camera.h"

#include <algorithm>

#include "hal/v4l2/device/v4l2_controls.h"
#include "hal/v4l2/device/v4l2_list.h"

namespace orbwatch::hal {
namespace {

/// The device's own name, if it is connected.
std::string model_of(const std::string& name) {
  const auto device = find_v4l2_device(name).and_then(V4l2Device::open);
  return device ? device->card() : "unknown";
}

}  // namespace

V4l2Camera::V4l2Camera(V4l2Settings settings, DmaBufferSources sources)
    : DeviceCamera({settings.device, model_of(settings.device), "v4l2"}),
      settings_(std::move(settings)),
      sources_(std::move(sources)) {}

V4l2Camera::~V4l2Camera() { stop(); }

DeviceResult<V4l2Device> V4l2Camera::open() const {
  return find_v4l2_device(settings_.device).and_then(V4l2Device::open);
}

Result<StreamFormat> V4l2Camera::do_configure(const StreamRequest& request) {
  if (auto sound = check(); !sound) return tl::unexpected(sound.error());
  auto device = open();
  if (!device) return fail(device.error().detail);
  uses_triggers_ = request.is_triggered;
  if (auto ready = set_up(*device, settings_.pixel_format, request); !ready)
    return fail(ready.error().detail);
  decoder_.reset();
  buffers_ = request.buffers;
  if (!negotiated_.is_zero_copy()) {
    decoder_ = std::make_unique<FrameDecoder>(negotiated_, request.buffers, request.keeps_jpeg);
    buffers_ = kDecodedDeviceBuffers;
  }
  StreamFormat format = negotiated_.stream;
  format.has_jpeg = request.keeps_jpeg && negotiated_.coding.packing == Packing::Jpeg;
  return format;
}

/// Checks that the settings are valid for any device.
Result<> V4l2Camera::check() const {
  const auto& names = kPixelCodingNames;
  if (std::find(names.begin(), names.end(), settings_.pixel_format) == names.end()) {
    std::string known;
    for (const auto name : names) known.append(known.empty() ? "" : ", ").append(name);
    return fail(settings_.device + ": pixel format \"" + settings_.pixel_format +
                "\"; it must be one of " + known);
  }
  return {};
}

/// Sets format and controls of an opened device.
DeviceResult<> V4l2Camera::set_up(V4l2Device& device, std::string_view pixel_format,
                                  const StreamRequest& request) {
  const auto negotiated =
      negotiate_format(device, {pixel_format, settings_.colour, request, settings_.frame_height,
                                settings_.first_row, settings_.is_radiometric});
  if (!negotiated) return tl::unexpected(negotiated.error());
  const std::lock_guard lock(controls_mutex_);
  if (auto done = set_controls(device); !done) {
    return fail(Fault::ReadError, done.error().message);
  }
  read_controls(device);
  negotiated_ = *negotiated;
  return {};
}

/// Sets the stored controls. Without triggers a device that an earlier configuration left waiting
/// for them runs freely again, unless a stored control is TriggerMode.
Result<> V4l2Camera::set_controls(V4l2Device& device) const {
  if (!uses_triggers_ && waits_for_trigger(device)) {
    if (auto done = set_control(device, "TriggerMode", 0); !done) return done;
  }
  for (const auto& [control, value] : controls_) {
    if (auto done = set_control(device, control, value); !done) return done;
  }
  return {};
}

/// Reads the controls that describe frames.
void V4l2Camera::read_controls(const V4l2Device& device) {
  triggered_ = waits_for_trigger(device);
  exposure_time_ = exposure_time(device);
}

Result<V4l2Camera::TriggerButton> V4l2Camera::find_button() const {
  auto device = open();
  if (!device) return fail(device.error().detail);
  const auto control = find_control(*device, "TriggerSoftware");
  if (!control) return tl::unexpected(control.error());
  if (control->type != V4L2_CTRL_TYPE_BUTTON) return fail("its TriggerSoftware is not a button");
  return TriggerButton{std::move(*device), *control};
}

Result<> V4l2Camera::trigger() {
  const std::lock_guard lock(button_mutex_);
  if (!button_) return fail(settings_.device + ": " + button_.error().message);
  if (auto done = button_->device.set_control(button_->control, 0); !done) {
    return fail(done.error().detail);
  }
  return {};
}

Result<> V4l2Camera::do_set(std::string_view control, double value) {
  // Controls do not belong to the stream: any descriptor of the device can set them.
  auto device = open();
  if (!device) return fail(device.error().detail);
  const std::lock_guard lock(controls_mutex_);
  if (auto done = set_control(*device, control, value); !done) return done;
  if (is_button(*device, control)) return {};
  read_controls(*device);
  const auto known = std::ranges::find(controls_, control, &Control::first);
  if (known != controls_.end()) {
    known->second = value;
  } else {
    controls_.emplace_back(control, value);
  }
  std::erase_if(controls_, [&](const Control& c) { return is_inactive(*device, c.first); });
  return {};
}

DeviceResult<double> V4l2Camera::open_stream() {
  auto device = open();
  if (!device) return tl::unexpected(device.error());
  if (auto ready = set_up_again(*device); !ready) return tl::unexpected(ready.error());
  auto stream = V4l2Stream::start(std::move(*device), negotiated_, buffers_, sources_());
  if (!stream) return tl::unexpected(stream.error());
  stream_ = std::move(*stream);
  notify(stream_->memory_text());
  const std::lock_guard lock(button_mutex_);
  button_ = find_button();
  return negotiated_.stream.frame_rate;
}

DeviceResult<std::size_t> V4l2Camera::capture(TimePoint deadline) {
  const auto captured = stream_->next(deadline);
  if (!captured) return tl::unexpected(captured.error());
  if (*captured) forward_intact(**captured);
  return *captured ? 1 : 0;
}

DeviceResult<> V4l2Camera::close_stream() {
  stream_.reset();
  const std::lock_guard lock(button_mutex_);
  button_ = fail("does not run");
  return {};
}

/// Sets up with the configured format, which frames in use and the decoder's buffers have.
DeviceResult<> V4l2Camera::set_up_again(V4l2Device& device) {
  const NegotiatedFormat before = negotiated_;
  const StreamFormat& stream = before.stream;
  auto ready = set_up(device, before.coding.name, {stream.width, stream.height, stream.frame_rate});
  if (ready && decoder_) decoder_->follow(negotiated_);
  return ready;
}

void V4l2Camera::forward_intact(const V4l2Stream::Captured& captured) {
  const FrameStamp stamp = frame_stamp(captured.buffer, Clock::now());
  FrameMetadata metadata{.sequence = sequence_of(captured.buffer.sequence),
                         .exposure_start = stamp.moment,
                         .stamp_source = stamp.source,
                         .exposure_time = exposure_time_};
  auto frame = intact_frame(captured);
  if (!frame) return discard(metadata, settings_.device + ": " + frame.error().message);
  // All buffers of decoded frames are in use: the frame is lost, a gap in the sequence.
  if (!*frame) return;
  if (decoder_ && decoder_->is_flawed()) metadata.status = FrameStatus::Flawed;
  (*frame)->metadata = metadata;
  forward(std::move(*frame));
}

/// The frame that the driver delivered, decoded if necessary; null when there is no buffer for it.
/// Error: it is damaged.
Result<std::shared_ptr<FrameBuffer>> V4l2Camera::intact_frame(
    const V4l2Stream::Captured& captured) {
  if ((captured.buffer.flags & V4L2_BUF_FLAG_ERROR) != 0) {
    return fail("the driver marks a frame as damaged");
  }
  for (std::size_t i = 0; i < negotiated_.layout.memory_count; ++i) {
    const std::size_t got = captured.samples(i).size();
    const std::size_t needed = negotiated_.layout.needed[i];
    if (got >= needed) continue;
    return fail("a frame of " + std::to_string(got) + " bytes; it takes " + std::to_string(needed));
  }
  if (decoder_) return decoder_->decode(captured.samples(0));
  return captured.frame;
}

std::unique_ptr<Camera> make_camera(V4l2Settings settings, const CameraContext& context) {
  settings.is_radiometric = context.kelvin_per_count > 0;
  return std::make_unique<V4l2Camera>(std::move(settings));
}

}  // namespace orbwatch::hal
