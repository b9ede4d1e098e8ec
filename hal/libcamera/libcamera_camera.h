#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "hal/device_camera.h"
#include "hal/libcamera/camera_manager.h"
#include "hal/libcamera/control_settings.h"
#include "hal/libcamera/libcamera_stream.h"
#include "hal/libcamera/sensor_mode.h"

namespace orbwatch::hal {

/// Which of libcamera's cameras, and how.
struct LibcameraSettings {
  /// libcamera's id (`cam --list`), or a part of id or sensor model that only one camera has.
  std::string camera;
  std::string pixel_format = "auto";  ///< "auto" or a name of kLibcameraFormats
  SensorMode sensor_mode = {};        ///< if set, this one or none
};

/// A camera behind libcamera. Frames are handed on in the device's own memory.
/// The camera is acquired only while it runs or is configured. When it breaks off, is removed, or
/// is silent for longer than stall_timeout(), it is released and acquired again after a BackOff.
class LibcameraCamera : public DeviceCamera {
 public:
  explicit LibcameraCamera(LibcameraSettings settings);
  ~LibcameraCamera() override;

  /// See put_control(). Goes along with the next frame that the camera begins, and is set again
  /// whenever the camera starts. Error, too: the camera is not there.
  Result<> set(std::string_view control, double value) override;

 protected:
  /// Errors: no such camera, or several; busy; size, format or sensor mode not on offer.
  Result<StreamFormat> do_configure(const StreamRequest& request) override;
  FaultReport stream_until_fault(const std::stop_token& stop) override;

 private:
  using SharedManager = std::shared_ptr<libcamera::CameraManager>;

  LibcameraCamera(LibcameraSettings settings, SharedManager manager);
  Result<> check() const;
  /// The libcamera id that the settings name, once the camera was there.
  Result<std::string> find();
  Result<std::shared_ptr<libcamera::Camera>> open();
  DeviceResult<std::unique_ptr<LibcameraStream>> start_again();
  FaultReport stream_with(LibcameraStream& stream, const std::stop_token& stop);
  std::string lost_text() const;
  void take(const LibcameraStream::Captured& captured);
  bool is_whole(const LibcameraStream::Captured& captured);

  LibcameraSettings settings_;
  /// Of id_, manager_, is_lost_, and of the camera's list of controls while it is configured.
  std::mutex camera_mutex_;
  SharedManager manager_;  ///< null while libcamera does not start
  bool is_lost_ = false;   ///< for good: see has_lost_its_nodes()
  std::string id_;         ///< libcamera's; a replugged camera has to be the same
  StreamFormat format_;
  std::string_view pixel_format_;
  double expected_rate_ = 0;
  ControlSettings controls_;
};

}  // namespace orbwatch::hal
