// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "hal/device_camera.h"
#include "hal/frame/dma_heap.h"
#include "hal/libcamera/camera_manager.h"
#include "hal/libcamera/controls/libcamera_controls.h"
#include "hal/libcamera/format/camera_configuration.h"
#include "hal/libcamera/libcamera_stream.h"

namespace orbwatch::hal {

/// Camera behind libcamera. Frames are forwarded in memory of a dma-heap, or in the driver's own if
/// there is none. The camera is acquired only while it runs or is configured.
class LibcameraCamera : public DeviceCamera {
 public:
  /// `sources` must not include memory that the camera's driver may refuse, which would end the
  /// process.
  explicit LibcameraCamera(
      LibcameraSettings settings,
      DmaBufferSources sources = [] { return dma_heaps_for_any_device(); });
  ~LibcameraCamera() override;

 protected:
  /// See put_control(). Applied with the next request, and again at each start. Further error: the
  /// camera is not connected.
  Result<> do_set(std::string_view control, double value) override;
  /// Controls are sent with a request behind those that are queued; Raspberry Pi's sensors apply
  /// exposure and gain up to 3 frames after it (libcamera's DelayedControls).
  std::size_t control_delay() const override { return buffers_ + 3; }
  /// Errors: no such camera, or several; busy; size, format or sensor mode not offered.
  Result<StreamFormat> do_configure(const StreamRequest& request) override;
  DeviceResult<double> open_stream() override;
  DeviceResult<std::size_t> capture(TimePoint deadline) override;
  bool may_be_silent() const override { return stream_->is_starved(); }
  void interrupt() override { stream_->wake(); }
  DeviceResult<> close_stream() override;

 private:
  using SharedManager = std::shared_ptr<libcamera::CameraManager>;

  LibcameraCamera(LibcameraSettings settings, DmaBufferSources sources, SharedManager manager);
  Result<> check() const;
  /// libcamera's id of the settings' camera, once it was connected.
  Result<std::string> find();
  Result<std::shared_ptr<libcamera::Camera>> open();
  DeviceResult<std::unique_ptr<LibcameraStream>> start_again();
  std::string lost_text() const;
  void forward_intact(const LibcameraStream::Captured& captured);
  static Result<> check_intact(const LibcameraStream::Captured& captured);

  LibcameraSettings settings_;
  DmaBufferSources sources_;
  /// Guards id_, manager_, is_lost_, and the camera's list of controls while it is configured.
  std::mutex camera_mutex_;
  SharedManager manager_;  ///< null while libcamera does not start
  bool is_lost_ = false;   ///< lost permanently: see has_lost_its_nodes()
  std::string id_;         ///< libcamera's id; the same after a reconnection
  StreamFormat format_;
  std::size_t buffers_ = kFreeRunningBuffers;
  std::string_view pixel_format_;
  double expected_rate_ = 0;
  ControlSettings controls_;
  std::unique_ptr<LibcameraStream> stream_;  ///< stream while it is open
};

}  // namespace orbwatch::hal
