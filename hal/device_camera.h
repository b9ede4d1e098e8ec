#pragma once

#include "hal/camera.h"
#include "hal/frame_counter.h"

namespace orbwatch::hal {

/// A camera whose device may break off: it is opened again after a BackOff, until it is back.
class DeviceCamera : public Camera {
 protected:
  using Camera::Camera;

  /// Opens the device and streams; returns what ended it, which means nothing after a stop.
  virtual FaultReport stream_until_fault(const std::stop_token& stop) = 0;

  /// For stream_until_fault(): hands a whole frame on, which ends a fault.
  void hand_on(std::shared_ptr<FrameBuffer> frame);

  void run(const std::stop_token& stop) final;

  FrameCounter counter_;  ///< numbers frames across returns of the device

 private:
  bool delivered_ = false;  ///< since the device was opened
};

}  // namespace orbwatch::hal
