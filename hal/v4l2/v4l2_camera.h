#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/camera.h"
#include "hal/frame_counter.h"
#include "hal/frame_pool.h"
#include "hal/jpeg/jpeg_decoder.h"
#include "hal/v4l2/v4l2_format.h"
#include "hal/v4l2/v4l2_stream.h"

namespace orbwatch::hal {

/// Which V4L2 device, and in which format.
struct V4l2Settings {
  /// A device node. Prefer the links in /dev/v4l/by-id or by-path: they name the same camera after
  /// it was plugged in again, while /dev/video0 may then be another.
  std::string device = "/dev/video0";
  std::string pixel_format = "auto";  ///< "auto" or a name of kV4l2Formats
};

/// A USB or other V4L2 camera. Uncompressed frames are handed on in the driver's own memory; MJPEG
/// is decoded here, and damaged pictures are withheld and reported.
/// The device is open only while the camera runs or a call needs it. When it breaks off, is silent
/// for longer than max(1 s, 5 periods) or comes back with another format, it is closed and opened
/// again after 1 s, then 2 s, up to every 10 s.
class V4l2Camera : public Camera {
 public:
  explicit V4l2Camera(V4l2Settings settings);
  ~V4l2Camera() override;

  /// See set_control(). The value is set again whenever the camera is opened anew, as USB cameras
  /// forget it when they lose power; unless a later setting gave the control to an automatism.
  Result<> set(std::string_view control, double value) override;

 protected:
  /// Errors: no such device or not a camera, busy, size or format not on offer.
  Result<StreamFormat> do_configure(const StreamRequest& request) override;
  void run(const std::stop_token& stop) override;

 private:
  using Setting = std::pair<std::string, double>;

  Result<> check(const StreamRequest& request) const;
  FaultReport stream_until_fault(const std::stop_token& stop);
  DeviceResult<V4l2Agreement> open_again(V4l2Device& device);
  void take(const V4l2Stream::Captured& captured);
  bool is_whole(const V4l2Stream::Captured& captured);
  void hand_on(std::shared_ptr<FrameBuffer> frame, const FrameMetadata& metadata);
  std::shared_ptr<FrameBuffer> decode(const V4l2Stream::Captured& captured);

  V4l2Settings settings_;
  V4l2Agreement agreed_;
  std::optional<FramePool> decoded_;  ///< for MJPEG
  JpegDecoder decoder_;
  FrameCounter counter_;
  bool delivered_ = false;  ///< since the device was opened
  std::mutex controls_mutex_;
  std::vector<Setting> controls_;  ///< what was set, in the order in which it first could be
};

}  // namespace orbwatch::hal
