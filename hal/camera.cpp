// SPDX-License-Identifier: Apache-2.0
#include "hal/camera.h"

#include <algorithm>
#include <utility>

namespace orbwatch::hal {
namespace {

/// Checks that a request is valid for any camera.
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
  if (request.buffers < 1 || request.buffers > kMaxBuffers) {
    return fail("asked for " + std::to_string(request.buffers) + " buffers; 1 to " +
                std::to_string(kMaxBuffers));
  }
  return {};
}

/// "cam video0" for "/dev/video0": the end of the path distinguishes cameras.
std::string thread_name(const std::string& id) { return "cam " + id.substr(id.rfind('/') + 1); }

}  // namespace

Camera::~Camera() = default;

Result<StreamFormat> Camera::configure(const StreamRequest& request) {
  if (thread_.is_running()) {
    return fail("camera " + info_.id + ": configure while it runs; stop it first");
  }
  configured_ = false;
  was_started_ = false;
  if (auto sound = check(request); !sound) {
    return fail("camera " + info_.id + ": " + sound.error().message);
  }
  auto format = do_configure(request);
  configured_ = format.has_value();
  return format;
}

Result<> Camera::start(OnFrame on_frame, OnFault on_fault) {
  if (!configured_) return fail("camera " + info_.id + ": start before configure");
  if (thread_.is_running() && !thread_.stop_requested()) {
    return fail("camera " + info_.id + ": runs already");
  }
  thread_.stop();  // waits for a run that was stopped inside a callback of its own
  on_frame_ = std::move(on_frame);
  on_fault_ = std::move(on_fault);
  last_fault_ = Fault::None;
  withheld_ = 0;
  damage_.clear();
  control_delay_.clear();
  damaged_ = 0;
  flawed_ = 0;
  was_started_ = true;  // before the thread opens the stream: set() may be called meanwhile
  thread_.start(thread_name(info_.id), role(), [this] { run(thread_.stop_token()); });
  return {};
}

void Camera::stop() { thread_.stop(); }

Result<> Camera::trigger() { return fail("camera " + info_.id + ": has no software trigger"); }

Result<> Camera::set(std::string_view control, double value) {
  const std::lock_guard lock(setting_);
  auto done = do_set(control, value);
  if (!done && !keeps_controls_) return done;
  std::erase_if(kept_, [control](const auto& kept) { return kept.first == control; });
  if (!done) kept_.emplace_back(control, value);
  control_delay_.set(Clock::now());
  return {};
}

Result<> Camera::set_kept() {
  const std::lock_guard lock(setting_);
  keeps_controls_ = false;
  for (const auto& [control, value] : kept_) {
    if (auto done = do_set(control, value); !done) return done;
    control_delay_.set(Clock::now());
  }
  kept_.clear();
  return {};
}

Result<> Camera::do_set(std::string_view control, double) {
  return fail("has no control \"" + std::string(control) + "\"");
}

void Camera::deliver(std::shared_ptr<FrameBuffer> frame) {
  if (thread_.stop_requested()) return;
  FrameMetadata& metadata = frame->metadata;
  if (requires_stamps_ && metadata.stamp_source == StampSource::Arrival) {
    return discard(metadata,
                   "frame " + std::to_string(metadata.sequence) + " has the moment of its arrival",
                   Fault::NoTimeStamps);
  }
  metadata.exposure_start = exposure_start(metadata, stamps_);
  metadata.controls_as_of = control_delay_.as_of(metadata, control_delay());
  if (damage_.add_intact(metadata.exposure_start)) {
    metadata.status = FrameStatus::Withheld;
    passes_gate(metadata);
    return;
  }
  announce(Fault::None, {});
  if (!passes_gate(metadata)) return;
  if (metadata.status == FrameStatus::Flawed) ++flawed_;
  on_frame_(std::move(frame));
}

void Camera::discard(FrameMetadata metadata, std::string detail, Fault fault) {
  ++damaged_;
  metadata.status = FrameStatus::Withheld;
  metadata.exposure_start = exposure_start(metadata, stamps_);
  passes_gate(metadata);
  // Frames that are damaged in another way do not change the fault, which would flap.
  const bool was_fault = damage_.is_fault();
  if (damage_.add_damaged(metadata.exposure_start) && !was_fault) {
    announce(fault, std::move(detail));
  }
}

bool Camera::passes_gate(FrameMetadata& metadata) {
  if (gate_ && !gate_(metadata)) {
    ++withheld_;
    return false;
  }
  metadata.sequence -= withheld_;
  return true;
}

bool Camera::fails(const FaultScript& script, const FrameMetadata& metadata) {
  const Fault fault = script.at(metadata.sequence);
  if (fault == Fault::None) return false;
  std::string detail = "scripted at frame " + std::to_string(metadata.sequence);
  if (fault == Fault::CorruptFrame) {
    discard(metadata, std::move(detail));
  } else {
    report(fault, std::move(detail));
  }
  return true;
}

void Camera::report(Fault fault, std::string detail) {
  if (fault != Fault::None) damage_.clear();
  announce(fault, std::move(detail));
}

void Camera::announce(Fault fault, std::string detail) {
  if (fault == std::exchange(last_fault_, fault)) return;
  if (!thread_.stop_requested()) on_fault_({fault, std::move(detail)});
}

void Camera::notify(const std::string& text) {
  if (text == last_notice_) return;
  last_notice_ = text;
  if (on_notice_ && !thread_.stop_requested()) on_notice_(text);
}

bool Camera::wait_until(TimePoint moment) {
  while (thread_.wait_until(moment)) {
    if (Clock::now() >= moment) return true;
  }
  return false;
}

}  // namespace orbwatch::hal
