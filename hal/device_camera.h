// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hal/camera.h"

namespace orbwatch::hal {

/// Extends a driver's 32-bit frame counter, which wraps, restarts with each stream and is constant
/// with some drivers, to one sequence.
class FrameCounter {
 public:
  /// Marks the next frame as the first of a new stream; it follows the last one.
  void restart() { fresh_ = true; }

  /// Returns the number of a frame. It starts at 0 and grows with the driver's counter; by 1 for
  /// the first frame of a stream and when the driver's counter did not advance.
  std::uint64_t number(std::uint32_t driver_sequence) {
    const std::uint32_t step = driver_sequence - last_;
    const bool forward = step != 0 && step <= UINT32_MAX / 2;
    if (!fresh_ && forward) next_ += step - 1;
    fresh_ = false;
    last_ = driver_sequence;
    return next_++;
  }

 private:
  std::uint64_t next_ = 0;
  std::uint32_t last_ = 0;
  bool fresh_ = true;
};

/// Longest normal silence of a camera: 5 periods of `frame_rate`, at least 1 s; 5 s at an unknown
/// rate (0).
Clock::duration stall_timeout(double frame_rate);

/// A camera whose device may disconnect. This class is the loop that all such cameras share: it
/// opens the stream, captures, reports a device that is silent for longer than stall_timeout() as
/// stalled, closes, and opens again after a BackOff until the camera is stopped. Back-ends
/// implement the protected part, which the camera's thread calls in the order open_stream,
/// capture..., close_stream.
class DeviceCamera : public Camera {
 protected:
  using Camera::Camera;

  /// Opens the device as it was configured and starts it. Returns the frame rate to expect, 0 if
  /// unknown. After an error there is nothing to close.
  virtual DeviceResult<double> open_stream() = 0;

  /// Waits for frames and forwards them; returns how many were captured, 0 at `deadline` or after
  /// interrupt(). An error ends the stream.
  virtual DeviceResult<std::size_t> capture(TimePoint deadline) = 0;

  /// True while the device waits for a trigger or has no buffer to fill: silence is not a fault.
  virtual bool may_be_silent() const = 0;

  /// Ends a wait in capture(). Thread-safe.
  virtual void interrupt() = 0;

  /// Error: the device is lost for good; reported instead of the fault that ended the stream.
  virtual DeviceResult<> close_stream() = 0;

  /// For capture(): returns the number of a frame, also of one that is not forwarded.
  std::uint64_t sequence_of(std::uint32_t driver_sequence) {
    return counter_.number(driver_sequence);
  }

  /// For capture(): delivers an intact frame.
  void forward(std::shared_ptr<FrameBuffer> frame);

 private:
  void run(const std::stop_token& stop) final;
  FaultReport stream(const std::stop_token& stop);
  FaultReport capture_until_fault(const std::stop_token& stop, double frame_rate);

  FrameCounter counter_;    ///< numbers frames across reconnections
  bool forwarded_ = false;  ///< a frame was forwarded since the device was opened
};

}  // namespace orbwatch::hal
