#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "hal/device_camera.h"
#include "hal/v4l2/frame_decoder.h"
#include "hal/v4l2/v4l2_format.h"
#include "hal/v4l2/v4l2_stream.h"

namespace orbwatch::hal {

/// Which V4L2 device, and how.
struct V4l2Settings {
  /// A device node, or another name that find_v4l2_device() knows. Links in /dev/v4l/by-id or
  /// by-path and places on a bus name the same camera after it was plugged in again, while
  /// /dev/video0 may then be another.
  std::string device = "/dev/video0";
  std::string pixel_format = "auto";  ///< one of kPixelCodingNames
  bool colour = true;                 ///< see frame_format()
};

/// A USB, CSI or other V4L2 camera. Frames that the pipeline reads as they are, are handed on in
/// the driver's own memory; others are decoded here. Frames that are short, that the driver marks
/// as damaged or whose JPEG picture is damaged are withheld and reported.
/// The device is open only while the camera runs or a call needs it. When it breaks off, is silent
/// for longer than stall_timeout() without waiting for a trigger, or comes back with another
/// format, it is closed and opened again after a BackOff.
class V4l2Camera : public DeviceCamera {
 public:
  explicit V4l2Camera(V4l2Settings settings);
  ~V4l2Camera() override;

  /// Presses the driver's control TriggerSoftware. Errors as set().
  Result<> trigger() override;

  /// See set_control(). The value is set again whenever the camera is opened anew, as USB cameras
  /// forget it when they lose power; unless a later setting gave the control to an automatism.
  Result<> set(std::string_view control, double value) override;

 protected:
  /// Errors: no such device or not a camera, busy, size or format not on offer, a control that was
  /// set and cannot be now.
  Result<StreamFormat> do_configure(const StreamRequest& request) override;
  FaultReport stream_until_fault(const std::stop_token& stop) override;

 private:
  using Control = std::pair<std::string, double>;

  Result<> check() const;
  DeviceResult<V4l2Device> open() const;
  DeviceResult<> set_up(V4l2Device& device, std::string_view pixel_format,
                        const StreamRequest& request);
  DeviceResult<> set_up_again(V4l2Device& device);
  void take(const V4l2Stream::Captured& captured);
  bool is_whole(const V4l2Stream::Captured& captured);

  V4l2Settings settings_;
  V4l2Agreement agreed_;
  std::unique_ptr<FrameDecoder> decoder_;  ///< for what is not handed on as it is
  std::atomic<bool> triggered_ = false;    ///< silence is no fault
  std::mutex controls_mutex_;
  /// What was set, in the order in which it first could be.
  std::vector<Control> controls_;
};

}  // namespace orbwatch::hal
