// SPDX-License-Identifier: Apache-2.0
#include "hal/device_camera.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "hal/back_off.h"

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

/// Cameras settle their exposure before the first frame.
constexpr Clock::duration kFirstFrameTimeout = 5s;

}  // namespace

Clock::duration stall_timeout(double frame_rate) {
  if (frame_rate <= 0) return 5s;
  const std::chrono::duration<double> periods(5.0 / frame_rate);
  return std::max<Clock::duration>(1s, std::chrono::duration_cast<Clock::duration>(periods));
}

void DeviceCamera::run(const std::stop_token& stop) {
  counter_ = FrameCounter();
  BackOff pause;
  while (!stop.stop_requested()) {
    forwarded_ = false;
    const FaultReport fault = stream(stop);
    if (fault.fault == Fault::Unplugged) keep_controls();
    report(fault.fault, fault.detail);  // not after a stop
    if (forwarded_) pause.reset();
    if (!wait_until(Clock::now() + pause.next())) return;
  }
}

FaultReport DeviceCamera::stream(const std::stop_token& stop) {
  const auto frame_rate = open_stream();
  if (!frame_rate) return frame_rate.error();
  const auto ready = set_kept();
  const FaultReport fault = ready ? capture_until_fault(stop, *frame_rate)
                                  : FaultReport{Fault::Refused, ready.error().message};
  const auto closed = close_stream();
  return closed ? fault : closed.error();
}

FaultReport DeviceCamera::capture_until_fault(const std::stop_token& stop, double frame_rate) {
  const std::stop_callback interrupt_to_stop(stop, [this] { interrupt(); });
  counter_.restart();
  const Clock::duration timeout = stall_timeout(frame_rate);
  TimePoint deadline = Clock::now() + std::max(timeout, kFirstFrameTimeout);
  while (!stop.stop_requested()) {
    const bool silence_is_normal = may_be_silent();
    const auto captured = capture(deadline);
    if (!captured) return captured.error();
    if (*captured > 0 || silence_is_normal) {
      deadline = Clock::now() + timeout;
    } else if (Clock::now() >= deadline) {
      return {Fault::Stalled,
              info().id + ": no frame for " + std::to_string(timeout / 1ms) + " ms"};
    }
  }
  return {};
}

void DeviceCamera::forward(std::shared_ptr<FrameBuffer> frame) {
  forwarded_ = true;
  deliver(std::move(frame));
}

}  // namespace orbwatch::hal
