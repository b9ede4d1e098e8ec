#include "hal/v4l2/v4l2_camera.h"

#include <algorithm>
#include <chrono>
#include <stop_token>

#include "hal/back_off.h"
#include "hal/v4l2/buffer_stamps.h"
#include "hal/v4l2/v4l2_controls.h"
#include "hal/v4l2/v4l2_list.h"

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

/// What the device calls itself, if it is there.
std::string model_of(const std::string& name) {
  const auto device = find_v4l2_device(name).and_then(V4l2Device::open);
  return device ? device->card() : "unknown";
}

}  // namespace

V4l2Camera::V4l2Camera(V4l2Settings settings)
    : DeviceCamera({settings.device, model_of(settings.device), "v4l2"}),
      settings_(std::move(settings)) {}

V4l2Camera::~V4l2Camera() { stop(); }

DeviceResult<V4l2Device> V4l2Camera::open() const {
  return find_v4l2_device(settings_.device).and_then(V4l2Device::open);
}

Result<StreamFormat> V4l2Camera::do_configure(const StreamRequest& request) {
  if (auto sound = check(); !sound) return tl::unexpected(sound.error());
  auto device = open();
  if (!device) return fail(device.error().detail);
  if (auto ready = set_up(*device, settings_.pixel_format, request); !ready)
    return fail(ready.error().detail);
  decoder_.reset();
  if (!agreed_.is_handed_on()) decoder_ = std::make_unique<FrameDecoder>(agreed_);
  return agreed_.stream;
}

/// Whether the settings make sense for any device at all.
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

/// Format and controls of a device that was just opened.
DeviceResult<> V4l2Camera::set_up(V4l2Device& device, std::string_view pixel_format,
                                  const StreamRequest& request) {
  const auto agreed = agree_on_format(device, {pixel_format, settings_.colour, request});
  if (!agreed) return tl::unexpected(agreed.error());
  std::vector<Control> controls;
  {
    const std::lock_guard lock(controls_mutex_);
    controls = controls_;
  }
  for (const auto& [control, value] : controls) {
    if (auto done = set_control(device, control, value); !done) {
      return tl::unexpected(FaultReport{Fault::ReadError, done.error().message});
    }
  }
  triggered_ = waits_for_trigger(device);
  agreed_ = *agreed;
  return {};
}

Result<> V4l2Camera::trigger() { return set("TriggerSoftware", 1); }

Result<> V4l2Camera::set(std::string_view control, double value) {
  // Controls do not belong to the stream: any opened device will do, and no thread has to wait.
  auto device = open();
  if (!device) return fail(device.error().detail);
  if (auto done = set_control(*device, control, value); !done) return done;
  if (is_button(*device, control)) return {};
  triggered_ = waits_for_trigger(*device);
  const std::lock_guard lock(controls_mutex_);
  const auto known = std::find_if(controls_.begin(), controls_.end(),
                                  [control](const Control& c) { return c.first == control; });
  if (known != controls_.end()) {
    known->second = value;
  } else {
    controls_.emplace_back(control, value);
  }
  std::erase_if(controls_, [&](const Control& c) { return is_inactive(*device, c.first); });
  return {};
}

FaultReport V4l2Camera::stream_until_fault(const std::stop_token& stop) {
  auto device = open();
  if (!device) return device.error();
  if (auto ready = set_up_again(*device); !ready) return ready.error();
  const auto stream = V4l2Stream::start(std::move(*device), agreed_);
  if (!stream) return stream.error();
  const std::stop_callback wake(stop, [&stream] { (*stream)->ring(); });

  counter_.restart();
  const Clock::duration timeout = stall_timeout(agreed_.stream.frame_rate);
  TimePoint deadline = Clock::now() + std::max(timeout, kFirstFrameTimeout);
  while (!stop.stop_requested()) {
    const bool may_be_silent = (*stream)->is_starved() || triggered_;
    const auto captured = (*stream)->next(deadline);
    if (!captured) return captured.error();
    if (*captured) take(**captured);
    if (*captured || may_be_silent) {
      deadline = Clock::now() + timeout;
    } else if (Clock::now() >= deadline) {
      return {Fault::Stalled,
              settings_.device + ": no frame for " + std::to_string(timeout / 1ms) + " ms"};
    }
  }
  return {};
}

/// As it was configured: frames in use and buffers for decoded ones are of that kind.
DeviceResult<> V4l2Camera::set_up_again(V4l2Device& device) {
  const V4l2Agreement before = agreed_;
  const StreamFormat& stream = before.stream;
  auto ready = set_up(device, before.coding.name, {stream.width, stream.height, stream.frame_rate});
  if (ready && decoder_) decoder_->follow(agreed_);
  return ready;
}

void V4l2Camera::take(const V4l2Stream::Captured& captured) {
  const FrameStamp stamp = frame_stamp(captured.buffer, Clock::now());
  const FrameMetadata metadata{.sequence = counter_.number(captured.buffer.sequence),
                               .exposure_start = stamp.moment,
                               .stamp_source = stamp.source};
  if (!is_whole(captured)) return;
  std::shared_ptr<FrameBuffer> frame = captured.frame;
  if (decoder_) {
    auto decoded = decoder_->decode(captured.samples(0));
    if (!decoded) {
      return report(Fault::CorruptFrame, settings_.device + ": " + decoded.error().message);
    }
    frame = std::move(*decoded);
  }
  // All decoded buffers are in use: the frame is lost, which the gap in the sequence tells.
  if (!frame) return;
  frame->metadata = metadata;
  hand_on(std::move(frame));
}

/// Whether the driver delivered all of a frame; reports it if not.
bool V4l2Camera::is_whole(const V4l2Stream::Captured& captured) {
  if ((captured.buffer.flags & V4L2_BUF_FLAG_ERROR) != 0) {
    report(Fault::CorruptFrame, settings_.device + ": the driver marks a frame as damaged");
    return false;
  }
  for (std::size_t i = 0; i < agreed_.layout.memory_count; ++i) {
    const std::size_t got = captured.samples(i).size();
    const std::size_t needed = agreed_.layout.needed[i];
    if (got >= needed) continue;
    report(Fault::CorruptFrame, settings_.device + ": a frame of " + std::to_string(got) +
                                    " bytes; it takes " + std::to_string(needed));
    return false;
  }
  return true;
}

}  // namespace orbwatch::hal
