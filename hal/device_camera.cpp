#include "hal/device_camera.h"

#include <utility>

#include "hal/back_off.h"

namespace orbwatch::hal {

void DeviceCamera::run(const std::stop_token& stop) {
  counter_ = FrameCounter();
  BackOff pause;
  while (!stop.stop_requested()) {
    delivered_ = false;
    const FaultReport fault = stream_until_fault(stop);
    report(fault.fault, fault.detail);
    if (delivered_) pause.reset();
    if (!wait_until(stop, Clock::now() + pause.next())) return;
  }
}

void DeviceCamera::hand_on(std::shared_ptr<FrameBuffer> frame) {
  delivered_ = true;
  report(Fault::None);
  deliver(std::move(frame));
}

}  // namespace orbwatch::hal
