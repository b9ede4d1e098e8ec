// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/genicam_camera.h"

#include <algorithm>

#include "hal/genicam/device/count_scale.h"
#include "hal/genicam/device/features.h"
#include "hal/genicam/device/gige_identity.h"
#include "hal/genicam/device/open_camera.h"

namespace orbwatch::hal {
namespace {

/// Interval between readings of the camera's clock: crystals drift by some 50 us in it.
constexpr std::chrono::seconds kLatchPeriod{1};

/// Moments after which the residual of the clock's line is logged, once.
constexpr std::size_t kLoggedMoments = 10;

std::string_view words_of(ArvBufferStatus status) {
  switch (status) {
    case ARV_BUFFER_STATUS_TIMEOUT:
    case ARV_BUFFER_STATUS_MISSING_PACKETS:
      return "packets were lost";
    case ARV_BUFFER_STATUS_WRONG_PACKET_ID:
      return "packets have numbers beyond its end";
    case ARV_BUFFER_STATUS_SIZE_MISMATCH:
      return "it is larger than the camera said";
    default:
      return "it is not complete";
  }
}

}  // namespace

GenicamCamera::GenicamCamera(GenicamSettings settings)
    : DeviceCamera({settings.camera, "GenICam camera", std::string(GenicamSettings::kName)}),
      settings_(std::move(settings)) {}

GenicamCamera::~GenicamCamera() { stop(); }

/// Finds the camera and takes control of it, unless it already has control.
DeviceResult<> GenicamCamera::open() {
  if (camera_) return {};
  auto found = find_camera_again(settings_.camera, found_);
  if (!found) return fail(Fault::Unplugged, found.error().message);
  found_ = std::move(*found);
  auto opened = open_camera(found_);
  if (!opened) return tl::unexpected(opened.error());
  camera_ = std::move(*opened);
  is_set_up_ = false;
  return {};
}

/// Sets format and controls of the open camera.
DeviceResult<> GenicamCamera::set_up(std::string_view pixel_format, const StreamRequest& request) {
  is_set_up_ = false;
  auto negotiated = negotiate(camera_.get(), settings_, pixel_format, request);
  if (!negotiated) return tl::unexpected(negotiated.error());
  for (const auto& [control, value] : controls_) {
    if (auto done = set_now(control, value); !done) {
      return fail(Fault::Refused, done.error().message);
    }
  }
  format_ = *negotiated;
  read_features();
  is_set_up_ = true;
  return {};
}

/// Sets up a camera that reconnected. Fault: the scale of its counts has changed.
DeviceResult<> GenicamCamera::set_up_again() {
  const StreamFormat& stream = format_.stream;
  const std::optional<CountScale> before = count_scale_;
  auto done = set_up(format_.pixels->name, {stream.width, stream.height, stream.frame_rate});
  if (!done || !before || !count_scale_) return done;
  if (count_scale_->kelvin_per_count == before->kelvin_per_count) return {};
  const std::string changed = count_scale_->stated_by + ", before " + before->stated_by;
  count_scale_ = before;
  is_set_up_ = false;
  return fail(Fault::WrongFormat, "genicam: camera " + found_.id +
                                      ": came back with another scale of its counts: " + changed);
}

/// Reads the features that describe frames.
void GenicamCamera::read_features() {
  triggered_ = waits_for_trigger(camera_.get());
  exposure_time_ = exposure_time(camera_.get());
  count_scale_ = read_count_scale(camera_.get(), format_.pixels->name);
}

Result<StreamFormat> GenicamCamera::do_configure(const StreamRequest& request) {
  if (settings_.pixel_format != "auto" &&
      find_genicam_format(std::string_view(settings_.pixel_format)) == nullptr) {
    std::string known = "auto";
    for (const GenicamFormat& format : kGenicamFormats) known.append(", ").append(format.name);
    return fail("camera " + info().id + ": pixel format \"" + settings_.pixel_format +
                "\"; it must be one of " + known);
  }
  const std::lock_guard lock(device_mutex_);
  auto ready = open().and_then([&] { return set_up(settings_.pixel_format, request); });
  if (!ready) {
    camera_.reset();
    return fail(ready.error().detail);
  }
  decoder_.reset();
  buffers_ = request.buffers;
  if (!format_.is_zero_copy()) {
    decoder_ = std::make_unique<GenicamDecoder>(format_, request.buffers);
    buffers_ = kDecodedDeviceBuffers;
  }
  return format_.stream;
}

Result<> GenicamCamera::set_now(const std::string& control, double value) {
  auto done = set_feature(camera_.get(), control, value, settings_.trigger_source);
  if (!done) return fail("genicam: camera " + found_.id + ": " + done.error().message);
  return done;
}

Result<> GenicamCamera::do_set(std::string_view control, double value) {
  const std::string name(control);
  const std::lock_guard lock(device_mutex_);
  if (auto opened = open(); !opened) return fail(opened.error().detail);
  if (was_started() && !is_set_up_) {
    if (auto again = set_up_again(); !again) return fail(again.error().detail);
  }
  if (was_started() && would_rescale(camera_.get(), name, value)) {
    return fail("genicam: camera " + found_.id + ": control " + name +
                " cannot change after the start: it changes what a count means");
  }
  if (auto done = set_now(name, value); !done) {
    // A camera that does not answer is searched again at the next attempt.
    if (!runs_) camera_.reset();
    return done;
  }
  if (is_set_up_) read_features();
  const auto known = std::ranges::find(controls_, name, &Control::first);
  if (known != controls_.end()) {
    known->second = value;
  } else {
    controls_.emplace_back(name, value);
  }
  return {};
}

Result<> GenicamCamera::trigger() {
  const std::lock_guard lock(device_mutex_);
  if (!runs_) return fail("genicam: camera " + info().id + ": does not run");
  AravisError error;
  arv_camera_software_trigger(camera_.get(), error.out());
  if (error) return fail("genicam: camera " + found_.id + ": TriggerSoftware: " + error.message());
  return {};
}

std::optional<CountScale> GenicamCamera::count_scale() const {
  const std::lock_guard lock(device_mutex_);
  return count_scale_;
}

LinkCounts GenicamCamera::link_counts() const {
  const std::lock_guard lock(counts_mutex_);
  return counts_;
}

void GenicamCamera::count_link() {
  const LinkCounts now = stream_->link_counts();
  const std::lock_guard lock(counts_mutex_);
  counts_.missing_packets = ended_.missing_packets + now.missing_packets;
  counts_.resent_packets = ended_.resent_packets + now.resent_packets;
  counts_.underruns = ended_.underruns + now.underruns;
}

DeviceResult<double> GenicamCamera::open_stream() {
  const std::lock_guard lock(device_mutex_);
  auto started =
      open().and_then([&] { return is_set_up_ ? DeviceResult<>() : set_up_again(); }).and_then([&] {
        return GenicamStream::start(camera_.get(), format_, buffers_);
      });
  if (!started) {
    camera_.reset();
    return tl::unexpected(started.error());
  }
  stream_ = std::move(*started);
  blocks_ = {};
  clock_ = {};
  latch_ = TimestampLatch::find(camera_.get());
  latch_due_ = Clock::now();
  is_lost_ = false;
  is_clock_logged_ = false;
  runs_ = true;
  return format_.stream.frame_rate;
}

DeviceResult<std::size_t> GenicamCamera::capture(TimePoint deadline) {
  const bool silence_is_normal =
      may_be_silent();  // before the wait, during which buffers may return
  const auto captured = stream_->next(deadline);
  if (!captured) return lose(captured.error());
  if (*captured) {
    read_clock();
    forward_intact(**captured);
    log_clock_fit();
  }
  count_link();
  if (!*captured && Clock::now() >= deadline && !silence_is_normal) return lose(silence());
  return *captured ? 1 : 0;
}

/// Fault when no frame came in time.
FaultReport GenicamCamera::silence() {
  const std::string who = "genicam: camera " + found_.id;
  if (found_.is_gige() && !read_gige_identity(found_.address)) {
    stream_->give_up();
    return {Fault::Unplugged, who + ": does not answer any more"};
  }
  return {Fault::Stalled, who + ": sends no frames, but answers"};
}

/// Ends the stream by a fault. Reports it before the stream is closed, which takes seconds when the
/// camera does not answer.
tl::unexpected<FaultReport> GenicamCamera::lose(FaultReport fault) {
  is_lost_ = true;
  if (fault.fault == Fault::Unplugged) keep_controls();
  report(fault.fault, fault.detail);
  return tl::unexpected(std::move(fault));
}

DeviceResult<> GenicamCamera::close_stream() {
  const std::lock_guard lock(device_mutex_);
  runs_ = false;
  latch_.reset();
  count_link();
  ended_ = counts_;
  stream_.reset();
  if (is_lost_) camera_.reset();
  return {};
}

/// Called after a frame, when the camera certainly answers. While others use the device the clock
/// is left to a later frame: they may wait for the camera, frames must not.
void GenicamCamera::read_clock() {
  if (!latch_ || Clock::now() < latch_due_) return;
  const std::unique_lock lock(device_mutex_, std::try_to_lock);
  if (!lock) return;
  if (const auto now = latch_->read()) clock_.add_latched(now->device, now->before, now->after);
  latch_due_ = Clock::now() + kLatchPeriod;
}

void GenicamCamera::log_clock_fit() {
  if (is_clock_logged_ || clock_.moments() < kLoggedMoments) return;
  is_clock_logged_ = true;
  const auto residual = clock_.residual().value_or(std::chrono::nanoseconds(0));
  notify("time stamps by the camera's clock, " +
         std::string(latch_ ? "read every second" : "as frames arrive") + ": within " +
         std::to_string(residual / std::chrono::microseconds(1)) + " us rms");
}

FrameMetadata GenicamCamera::metadata_of(const GenicamStream::Captured& captured) {
  FrameMetadata metadata;
  metadata.sequence = sequence_of(blocks_.number(captured.id));
  metadata.exposure_time = exposure_time_;
  metadata.exposure_start = captured.arrival;
  if (!captured.id) {
    // Packets are sent from the start of the readout on. The stamp of the next frame may be
    // earlier, and keeps its value.
    metadata.stamp_source = StampSource::ReadoutStart;
    return metadata;
  }
  metadata.stamp_source = StampSource::Arrival;
  if (captured.stamp.count() != 0) {
    if (!latch_) clock_.add_arrival(captured.stamp, captured.arrival);
    if (const auto moment = clock_.to_steady(captured.stamp)) {
      metadata.exposure_start = std::min(*moment, captured.arrival);
      // The line of arrivals follows the fastest first packets, which are sent when the readout
      // begins.
      metadata.stamp_source = latch_ ? settings_.stamps_mark : StampSource::ReadoutStart;
    }
  }
  newest_ = std::max(metadata.exposure_start, newest_ + Clock::duration(1));
  metadata.exposure_start = newest_;
  return metadata;
}

void GenicamCamera::forward_intact(const GenicamStream::Captured& captured) {
  FrameMetadata metadata = metadata_of(captured);
  const auto stride = intact_stride(captured);
  if (!stride) {
    return discard(
        metadata, "genicam: camera " + info().id + ": a frame is damaged: " + stride.error().detail,
        stride.error().fault);
  }
  auto frame = frame_of(captured, *stride);
  if (!frame) return discard(metadata, frame.error().message);
  // All buffers of decoded frames are in use: the frame is lost, a gap in the sequence.
  if (!*frame) return;
  (*frame)->metadata = metadata;
  forward(std::move(*frame));
}

/// Bytes from row to row. Fault: the frame is damaged, or does not have the negotiated format.
DeviceResult<std::size_t> GenicamCamera::intact_stride(
    const GenicamStream::Captured& captured) const {
  if (captured.status != ARV_BUFFER_STATUS_SUCCESS) {
    return fail(Fault::CorruptFrame, std::string(words_of(captured.status)));
  }
  ArvBuffer* const buffer = captured.frame->buffer.get();
  const ArvBufferPayloadType payload = arv_buffer_get_payload_type(buffer);
  if (payload != ARV_BUFFER_PAYLOAD_TYPE_IMAGE &&
      payload != ARV_BUFFER_PAYLOAD_TYPE_EXTENDED_CHUNK_DATA) {
    return fail(Fault::WrongFormat, "not a picture, but a payload of type " +
                                        std::to_string(static_cast<int>(payload)));
  }
  const StreamFormat& stream = format_.stream;
  const int width = arv_buffer_get_image_width(buffer);
  const int height = arv_buffer_get_image_height(buffer);
  const ArvPixelFormat pixels = arv_buffer_get_image_pixel_format(buffer);
  if (width != stream.width || height != stream.height || pixels != format_.pixels->code) {
    return fail(Fault::WrongFormat, "it is " + format_name(pixels) + " of " +
                                        std::to_string(width) + "x" + std::to_string(height));
  }
  int padding = 0, end = 0;
  arv_buffer_get_image_padding(buffer, &padding, &end);
  const std::size_t stride = format_.stride(static_cast<std::size_t>(std::max(padding, 0)));
  const std::size_t needed = stride * static_cast<std::size_t>(height - 1) + format_.stride(0);
  std::size_t got = 0;
  arv_buffer_get_data(buffer, &got);
  if (std::min(got, captured.frame->capacity) < needed) {
    return fail(Fault::CorruptFrame,
                "it has " + std::to_string(got) + " bytes; it takes " + std::to_string(needed));
  }
  if (format_.is_zero_copy() &&
      stride % static_cast<std::size_t>(orbwatch::info(stream.format).bytes_per_sample()) != 0) {
    return fail(Fault::WrongFormat, "its rows end with " + std::to_string(padding) + " bytes");
  }
  return stride;
}

/// The received frame, decoded if necessary; null when there is no buffer for it.
Result<std::shared_ptr<FrameBuffer>> GenicamCamera::frame_of(
    const GenicamStream::Captured& captured, std::size_t stride) {
  if (decoder_) return decoder_->decode(captured.frame->memory, stride);
  const StreamFormat& stream = format_.stream;
  captured.frame->picture =
      Picture::contiguous(stream.format, stream.width, stream.height, captured.frame->memory,
                          static_cast<std::ptrdiff_t>(stride));
  captured.frame->picture.colour_space = stream.colour_space;
  return captured.frame;
}

}  // namespace orbwatch::hal
