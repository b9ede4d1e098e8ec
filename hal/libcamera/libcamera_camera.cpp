// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/libcamera_camera.h"

#include <algorithm>

#include "hal/libcamera/libcamera_frame.h"

namespace orbwatch::hal {
namespace {

CameraInfo info_of(const std::string& wanted, libcamera::CameraManager* manager) {
  CameraInfo info{wanted, "unknown", "libcamera"};
  if (manager == nullptr) return info;
  const auto id = choose_camera(list_cameras(*manager), wanted);
  const auto camera = id ? manager->get(*id) : nullptr;
  if (camera) info.model = model_of(*camera);
  return info;
}

std::size_t used_bytes(const libcamera::FrameMetadata& buffer) {
  std::size_t used = 0;
  for (const auto& plane : buffer.planes()) used += plane.bytesused;
  return used;
}

}  // namespace

LibcameraCamera::LibcameraCamera(LibcameraSettings settings, DmaBufferSources sources)
    : LibcameraCamera(std::move(settings), std::move(sources), camera_manager().value_or(nullptr)) {
}

LibcameraCamera::LibcameraCamera(LibcameraSettings settings, DmaBufferSources sources,
                                 SharedManager manager)
    : DeviceCamera(info_of(settings.camera, manager.get())),
      settings_(std::move(settings)),
      sources_(std::move(sources)),
      manager_(std::move(manager)) {}

LibcameraCamera::~LibcameraCamera() { stop(); }

/// Checks that the settings are valid for any camera.
Result<> LibcameraCamera::check() const {
  const std::string who = "camera " + info().id + ": ";
  std::string names = "auto";
  bool known = settings_.pixel_format == names;
  for (const LibcameraFormat& format : kLibcameraFormats) {
    names += ", " + std::string(format.name);
    known = known || settings_.pixel_format == format.name;
  }
  if (!known) {
    return fail(who + "pixel format \"" + settings_.pixel_format + "\"; it must be one of " +
                names);
  }
  const SensorMode& mode = settings_.sensor_mode;
  if (mode.is_set() && (std::min({mode.width, mode.height, mode.bit_depth}) <= 0 ||
                        std::max(mode.width, mode.height) > kMaxSide || mode.bit_depth > 32)) {
    return fail(who + "sensor mode " + to_text(mode) + "; it needs width, height and bit depth");
  }
  return {};
}

Result<std::string> LibcameraCamera::find() {
  if (!manager_) {
    auto manager = camera_manager();
    if (!manager) return tl::unexpected(manager.error());
    manager_ = std::move(*manager);
  }
  if (!id_.empty()) return id_;
  return choose_camera(list_cameras(*manager_), settings_.camera);
}

Result<std::shared_ptr<libcamera::Camera>> LibcameraCamera::open() {
  if (is_lost_) return fail(lost_text());
  const auto id = find();
  if (!id) return tl::unexpected(id.error());
  auto camera = manager_->get(*id);
  if (!camera) return fail("libcamera: camera \"" + *id + "\" is not connected");
  return camera;
}

Result<StreamFormat> LibcameraCamera::do_configure(const StreamRequest& request) {
  if (auto sound = check(); !sound) return tl::unexpected(sound.error());
  const std::lock_guard lock(camera_mutex_);
  auto camera = open();
  if (!camera) return tl::unexpected(camera.error());
  const auto acquired = AcquiredCamera::acquire(std::move(*camera));
  if (!acquired) return fail(acquired.error().detail);
  const auto negotiated =
      negotiate_configuration(**acquired, settings_.pixel_format, settings_.sensor_mode, request);
  if (!negotiated) return tl::unexpected(negotiated.error());
  id_ = (*acquired)->id();
  format_ = negotiated->stream;
  buffers_ = request.buffers;
  pixel_format_ = negotiated->pixels->name;
  expected_rate_ = format_.frame_rate != 0 ? format_.frame_rate : request.frame_rate;
  return format_;
}

Result<> LibcameraCamera::do_set(std::string_view control, double value) {
  const std::lock_guard lock(camera_mutex_);
  const auto camera = open();
  if (!camera) return tl::unexpected(camera.error());
  if (auto done = controls_.set((*camera)->controls(), control, value); !done) {
    return fail((*camera)->id() + ": " + done.error().message);
  }
  return {};
}

DeviceResult<double> LibcameraCamera::open_stream() {
  auto started = start_again();
  if (!started) return tl::unexpected(started.error());
  stream_ = std::move(*started);
  notify(stream_->memory_text());
  return expected_rate_;
}

DeviceResult<std::size_t> LibcameraCamera::capture(TimePoint deadline) {
  return stream_->wait(deadline, [this](const auto& captured) { forward_intact(captured); });
}

DeviceResult<> LibcameraCamera::close_stream() {
  if (stream_->end()) {
    stream_.reset();
    return {};
  }
  const std::lock_guard lock(camera_mutex_);
  is_lost_ = true;
  // Leaked on purpose: libcamera crashes when they are destroyed.
  static_cast<void>(stream_.release());
  static_cast<void>(new SharedManager(manager_));
  return fail(Fault::Unplugged, lost_text());
}

std::string LibcameraCamera::lost_text() const {
  return id_ + ": its driver released it, unnoticed by libcamera; restart this program";
}

/// Starts the camera with the configured format.
DeviceResult<std::unique_ptr<LibcameraStream>> LibcameraCamera::start_again() {
  const std::lock_guard lock(camera_mutex_);
  auto camera = open();
  if (!camera) return fail(Fault::Unplugged, camera.error().message);
  auto acquired = AcquiredCamera::acquire(std::move(*camera));
  if (!acquired) return tl::unexpected(acquired.error());
  const StreamRequest request{format_.width, format_.height, format_.frame_rate, buffers_};
  const auto negotiated =
      negotiate_configuration(**acquired, pixel_format_, settings_.sensor_mode, request);
  if (!negotiated) return fail(Fault::WrongFormat, negotiated.error().message);
  return LibcameraStream::start(std::move(*acquired), *negotiated, controls_, sources_());
}

void LibcameraCamera::forward_intact(const LibcameraStream::Captured& captured) {
  FrameMetadata metadata =
      metadata_of(captured.metadata, captured.buffer.timestamp, ClockReading::now());
  metadata.sequence = sequence_of(captured.buffer.sequence);
  const libcamera::ControlId* const other = controls_.find_other(captured.metadata);
  metadata.not_as_set = other ? other->name().c_str() : nullptr;
  if (auto intact = check_intact(captured); !intact) {
    return discard(metadata, id_ + ": " + intact.error().message);
  }
  captured.frame->metadata = metadata;
  forward(captured.frame);
}

/// Error when the frame is damaged.
Result<> LibcameraCamera::check_intact(const LibcameraStream::Captured& captured) {
  if (captured.buffer.status != libcamera::FrameMetadata::FrameSuccess) {
    return fail("the driver marks a frame as damaged");
  }
  const Picture& picture = captured.frame->picture;
  // The last row may be unpadded.
  const auto stride = static_cast<std::size_t>(picture.planes[0].stride);
  const std::size_t padding =
      stride - static_cast<std::size_t>(row_bytes(picture.format, picture.width));
  const std::size_t needed = picture_bytes(picture.format, stride, picture.height) - padding;
  const std::size_t used = used_bytes(captured.buffer);
  if (used >= needed) return {};
  return fail("a frame of " + std::to_string(used) + " bytes; it takes " + std::to_string(needed));
}

}  // namespace orbwatch::hal
