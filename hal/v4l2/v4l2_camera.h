// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "hal/device_camera.h"
#include "hal/frame/dma_heap.h"
#include "hal/v4l2/format/frame_decoder.h"
#include "hal/v4l2/format/v4l2_format.h"
#include "hal/v4l2/v4l2_settings.h"
#include "hal/v4l2/v4l2_stream.h"

namespace orbwatch::hal {

/// USB, CSI or other V4L2 camera. Frames are forwarded in memory of a dma-heap that the driver
/// imports, in the driver's own if it does not import, or decoded if the pipeline does not read
/// their format. Frames that are short, damaged according to the driver, or whose JPEG picture is
/// damaged are withheld and counted. The device is open only while the camera runs or a call needs
/// it. Without triggers it runs freely unless its stored control TriggerMode is on; silence while
/// it waits for a trigger is not a fault.
class V4l2Camera : public DeviceCamera {
 public:
  explicit V4l2Camera(
      V4l2Settings settings, DmaBufferSources sources = [] { return dma_heaps(); });
  ~V4l2Camera() override;

  /// Presses the driver's button TriggerSoftware. Errors: the camera does not run, has no such
  /// button, or the driver refuses.
  Result<> trigger() override;

 protected:
  /// See set_control(). The value is set again after each reconnection, since USB cameras lose it
  /// with their power, unless a later setting put the control under automatic control.
  Result<> do_set(std::string_view control, double value) override;
  /// Drivers set controls at once, sensors apply them 2 exposures later; one more for a camera that
  /// computes its exposures ahead, and one for stamps that mark a frame's end.
  std::size_t control_delay() const override { return 4; }
  /// Errors: no such device or not a camera, busy, size or format not offered, a stored control
  /// that cannot be set.
  Result<StreamFormat> do_configure(const StreamRequest& request) override;
  DeviceResult<double> open_stream() override;
  DeviceResult<std::size_t> capture(TimePoint deadline) override;
  bool may_be_silent() const override { return stream_->is_starved() || triggered_; }
  void interrupt() override { stream_->wake(); }
  DeviceResult<> close_stream() override;

 private:
  using Control = std::pair<std::string, double>;
  /// Uses a descriptor of its own, so that a trigger is one call.
  struct TriggerButton {
    V4l2Device device;
    v4l2_query_ext_ctrl control;
  };

  Result<> check() const;
  DeviceResult<V4l2Device> open() const;
  Result<TriggerButton> find_button() const;
  DeviceResult<> set_up(V4l2Device& device, std::string_view pixel_format,
                        const StreamRequest& request);
  DeviceResult<> set_up_again(V4l2Device& device);
  Result<> set_controls(V4l2Device& device) const;
  void read_controls(const V4l2Device& device);
  void forward_intact(const V4l2Stream::Captured& captured);
  Result<std::shared_ptr<FrameBuffer>> intact_frame(const V4l2Stream::Captured& captured);

  V4l2Settings settings_;
  DmaBufferSources sources_;
  NegotiatedFormat negotiated_;
  std::size_t buffers_ = kFreeRunningBuffers;  ///< number of the driver's buffers
  bool uses_triggers_ = false;                 ///< StreamRequest::is_triggered
  std::unique_ptr<FrameDecoder> decoder_;      ///< decoder for formats that are not zero-copy
  std::unique_ptr<V4l2Stream> stream_;         ///< stream while it is open
  std::atomic<bool> triggered_ = false;        ///< the camera waits for triggers
  std::atomic<std::chrono::microseconds> exposure_time_{};  ///< exposure_time(), cached
  std::mutex button_mutex_;
  Result<TriggerButton> button_ = fail("does not run");
  std::mutex controls_mutex_;  ///< held until device and stored controls agree
  /// The stored controls, in the order of their first setting.
  std::vector<Control> controls_;
};

}  // namespace orbwatch::hal
