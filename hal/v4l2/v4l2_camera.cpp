#include "hal/v4l2/v4l2_camera.h"

#include <algorithm>
#include <chrono>
#include <stop_token>

#include "hal/v4l2/buffer_stamps.h"
#include "hal/v4l2/v4l2_controls.h"

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

constexpr int kMaxFrameRate = 1000;
constexpr Clock::duration kFirstPause = 1s;
constexpr Clock::duration kLongestPause = 10s;
/// Cameras settle their exposure before the first frame.
constexpr Clock::duration kFirstFrameTimeout = 5s;

Clock::duration stall_timeout(double frame_rate) {
  if (frame_rate <= 0) return 1s;
  const std::chrono::duration<double> periods(5.0 / frame_rate);
  return std::max<Clock::duration>(1s, std::chrono::duration_cast<Clock::duration>(periods));
}

/// What the device calls itself, if it is there.
std::string model_of(const std::string& device) {
  const auto opened = V4l2Device::open(device);
  return opened ? opened->card() : "unknown";
}

}  // namespace

V4l2Camera::V4l2Camera(V4l2Settings settings)
    : Camera({settings.device, model_of(settings.device), "v4l2"}),
      settings_(std::move(settings)) {}

V4l2Camera::~V4l2Camera() { stop(); }

Result<StreamFormat> V4l2Camera::do_configure(const StreamRequest& request) {
  if (auto sound = check(request); !sound) return tl::unexpected(sound.error());
  auto device = V4l2Device::open(settings_.device);
  if (!device) return fail(device.error().detail);
  const auto agreed = agree_on_format(*device, settings_.pixel_format, request);
  if (!agreed) return fail(agreed.error().detail);
  agreed_ = *agreed;
  decoded_.reset();
  if (agreed_.pixels.fourcc == V4L2_PIX_FMT_MJPEG) {
    decoded_ = make_frame_pool(PixelFormat::Rgb, agreed_.stream.width, agreed_.stream.height);
  }
  return agreed_.stream;
}

/// Whether request and settings make sense for any device at all.
Result<> V4l2Camera::check(const StreamRequest& request) const {
  std::string names = "auto";
  bool known = settings_.pixel_format == names;
  for (const V4l2Format& format : kV4l2Formats) {
    names += ", " + std::string(format.name);
    known = known || settings_.pixel_format == format.name;
  }
  if (!known) {
    return fail(settings_.device + ": pixel format \"" + settings_.pixel_format +
                "\"; it must be one of " + names);
  }
  if (std::min(request.width, request.height) < 0 ||
      std::max(request.width, request.height) > kMaxV4l2Side) {
    return fail(settings_.device + ": asked for " + std::to_string(request.width) + "x" +
                std::to_string(request.height) + "; at most " + std::to_string(kMaxV4l2Side) +
                " pixels a side");
  }
  if (!(request.frame_rate >= 0 && request.frame_rate <= kMaxFrameRate)) {
    return fail(settings_.device + ": asked for " + std::to_string(request.frame_rate) +
                " frames per second; at most " + std::to_string(kMaxFrameRate));
  }
  return {};
}

Result<> V4l2Camera::set(std::string_view control, double value) {
  // Controls do not belong to the stream: any opened device will do, and no thread has to wait.
  auto device = V4l2Device::open(settings_.device);
  if (!device) return fail(device.error().detail);
  if (auto done = set_control(*device, control, value); !done) return done;
  const std::lock_guard lock(controls_mutex_);
  const auto known = std::find_if(controls_.begin(), controls_.end(),
                                  [control](const Setting& s) { return s.first == control; });
  if (known != controls_.end()) {
    known->second = value;
  } else {
    controls_.emplace_back(control, value);
  }
  std::erase_if(controls_, [&](const Setting& s) { return is_inactive(*device, s.first); });
  return {};
}

void V4l2Camera::run(const std::stop_token& stop) {
  counter_ = FrameCounter();
  Clock::duration pause = kFirstPause;
  while (!stop.stop_requested()) {
    delivered_ = false;
    const FaultReport fault = stream_until_fault(stop);
    report(fault.fault, fault.detail);
    if (delivered_) pause = kFirstPause;
    if (!wait_until(stop, Clock::now() + pause)) return;
    pause = std::min(2 * pause, kLongestPause);
  }
}

/// Opens the device and streams; returns what ended it, which means nothing after a stop.
FaultReport V4l2Camera::stream_until_fault(const std::stop_token& stop) {
  auto device = V4l2Device::open(settings_.device);
  if (!device) return device.error();
  const auto agreed = open_again(*device);
  if (!agreed) return agreed.error();
  const auto stream = V4l2Stream::start(std::move(*device), *agreed);
  if (!stream) return stream.error();
  const std::stop_callback wake(stop, [&stream] { (*stream)->ring(); });

  counter_.restart();
  const Clock::duration timeout = stall_timeout(agreed->stream.frame_rate);
  TimePoint deadline = Clock::now() + std::max(timeout, kFirstFrameTimeout);
  while (!stop.stop_requested()) {
    const bool starved = (*stream)->is_starved();
    const auto captured = (*stream)->next(deadline);
    if (!captured) return captured.error();
    if (*captured) take(**captured);
    if (*captured || starved) {
      deadline = Clock::now() + timeout;
    } else if (Clock::now() >= deadline) {
      return {Fault::Stalled,
              settings_.device + ": no frame for " + std::to_string(timeout / 1ms) + " ms"};
    }
  }
  return {};
}

/// Sets up a device that was opened anew as it was configured.
DeviceResult<V4l2Agreement> V4l2Camera::open_again(V4l2Device& device) {
  const StreamRequest request{agreed_.stream.width, agreed_.stream.height,
                              agreed_.stream.frame_rate};
  const auto agreed = agree_on_format(device, agreed_.pixels.name, request);
  if (!agreed) return agreed;
  std::vector<Setting> controls;
  {
    const std::lock_guard lock(controls_mutex_);
    controls = controls_;
  }
  for (const auto& [control, value] : controls) {
    if (auto done = set_control(device, control, value); !done) {
      return tl::unexpected(FaultReport{Fault::ReadError, done.error().message});
    }
  }
  return agreed;
}

void V4l2Camera::take(const V4l2Stream::Captured& captured) {
  const FrameMetadata metadata{.sequence = counter_.number(captured.buffer.sequence),
                               .exposure_start = exposure_start(captured.buffer, Clock::now())};
  if (!is_whole(captured)) return;
  if (!decoded_) return hand_on(captured.frame, metadata);
  if (auto picture = decode(captured)) hand_on(std::move(picture), metadata);
}

/// Whether the driver delivered all of a frame; reports it if not.
bool V4l2Camera::is_whole(const V4l2Stream::Captured& captured) {
  const FrameBuffer& frame = *captured.frame;
  const Picture& picture = frame.picture;
  const auto stride = static_cast<std::size_t>(picture.planes[0].stride);
  const std::size_t needed = decoded_ ? 1 : picture_bytes(picture.format, stride, picture.height);
  const std::size_t used = captured.buffer.bytesused;
  if ((captured.buffer.flags & V4L2_BUF_FLAG_ERROR) != 0) {
    report(Fault::CorruptFrame, settings_.device + ": the driver marks a frame as damaged");
    return false;
  }
  if (used < needed || used > frame.capacity) {
    report(Fault::CorruptFrame, settings_.device + ": a frame of " + std::to_string(used) +
                                    " bytes; it takes " + std::to_string(needed));
    return false;
  }
  return true;
}

void V4l2Camera::hand_on(std::shared_ptr<FrameBuffer> frame, const FrameMetadata& metadata) {
  frame->metadata = metadata;
  delivered_ = true;
  report(Fault::None);
  deliver(std::move(frame));
}

/// The picture in a buffer of our own, or nullptr when it is damaged or all of those are lent.
std::shared_ptr<FrameBuffer> V4l2Camera::decode(const V4l2Stream::Captured& captured) {
  auto target = decoded_->acquire();
  if (!target) return nullptr;
  const Picture& picture = target->picture;
  const ImageView<std::uint8_t> pixels{reinterpret_cast<std::uint8_t*>(target->memory),
                                       picture.width, picture.height, 3, picture.planes[0].stride};
  const auto done =
      decoder_.decode_rgb({captured.frame->memory, captured.buffer.bytesused}, pixels);
  target->picture.colour_space = agreed_.stream.colour_space;
  if (done) return target;
  report(Fault::CorruptFrame, settings_.device + ": " + done.error().message);
  return nullptr;
}

}  // namespace orbwatch::hal
