#include "hal/camera.h"

#include <algorithm>
#include <utility>

namespace orbwatch::hal {
namespace {

/// Whether a request makes sense for any camera at all.
Result<> check(const StreamRequest& request) {
  if (std::min(request.width, request.height) < 0 ||
      std::max(request.width, request.height) > kMaxSide) {
    return fail("asked for the size " + std::to_string(request.width) + "x" +
                std::to_string(request.height) + "; at most " + std::to_string(kMaxSide) +
                " pixels a side");
  }
  if (!(request.frame_rate >= 0 && request.frame_rate <= kMaxFrameRate)) {
    return fail("asked for the frame rate " + std::to_string(request.frame_rate) + "; at most " +
                std::to_string(kMaxFrameRate) + " frames per second");
  }
  return {};
}

}  // namespace

Camera::~Camera() { join(); }

Result<StreamFormat> Camera::configure(const StreamRequest& request) {
  if (thread_.joinable()) {
    return fail("camera " + info_.id + ": configure while it runs; stop it first");
  }
  if (auto sound = check(request); !sound) {
    return fail("camera " + info_.id + ": " + sound.error().message);
  }
  auto format = do_configure(request);
  configured_ = format.has_value();
  return format;
}

Result<> Camera::start(OnFrame on_frame, OnFault on_fault) {
  if (!configured_) return fail("camera " + info_.id + ": start before configure");
  if (thread_.joinable() && !stop_.stop_requested()) {
    return fail("camera " + info_.id + ": runs already");
  }
  join();  // a thread that was stopped inside a callback of its own
  on_frame_ = std::move(on_frame);
  on_fault_ = std::move(on_fault);
  last_fault_ = Fault::None;
  withheld_ = 0;
  stop_ = std::stop_source();
  thread_ = std::thread([this, stop = stop_.get_token()] {
    runner_ = std::this_thread::get_id();
    run(stop);
  });
  return {};
}

void Camera::stop() {
  stop_.request_stop();
  if (std::this_thread::get_id() != runner_.load()) join();
}

void Camera::join() {
  if (!thread_.joinable()) return;
  stop_.request_stop();
  thread_.join();
  runner_ = std::thread::id();  // the system may give the same one to another thread
}

Result<> Camera::trigger() { return fail("camera " + info_.id + ": has no software trigger"); }

Result<> Camera::set(std::string_view control, double) {
  return fail("has no control \"" + std::string(control) + "\"");
}

void Camera::deliver(std::shared_ptr<FrameBuffer> frame) {
  if (stop_.stop_requested()) return;
  if (gate_ && !gate_(frame->metadata)) {
    ++withheld_;
    return;
  }
  frame->metadata.sequence -= withheld_;
  on_frame_(std::move(frame));
}

void Camera::report(Fault fault, std::string detail) {
  if (fault == std::exchange(last_fault_, fault)) return;
  if (!stop_.stop_requested()) on_fault_({fault, std::move(detail)});
}

bool Camera::wait_until(const std::stop_token& stop, TimePoint moment) {
  std::unique_lock lock(wait_mutex_);
  wake_.wait_until(lock, stop, moment, [] { return false; });
  return !stop.stop_requested();
}

}  // namespace orbwatch::hal
