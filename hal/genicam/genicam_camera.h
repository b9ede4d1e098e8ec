// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/device_camera.h"
#include "hal/genicam/clock/block_counter.h"
#include "hal/genicam/clock/device_clock.h"
#include "hal/genicam/device/found_camera.h"
#include "hal/genicam/device/timestamp_latch.h"
#include "hal/genicam/format/genicam_decoder.h"
#include "hal/genicam/genicam_settings.h"
#include "hal/genicam/genicam_stream.h"

namespace orbwatch::hal {

/// GigE Vision or USB3 Vision camera. Frames are forwarded in the buffer that was received, or
/// decoded if the pipeline does not read their format. Incomplete ones are withheld and counted.
/// From configure() on it controls the camera, so that no other host can, until its end or the loss
/// of the connection. Silence while it waits for a trigger is not a fault.
class GenicamCamera : public DeviceCamera {
 public:
  explicit GenicamCamera(GenicamSettings settings);
  ~GenicamCamera() override;

  /// Executes TriggerSoftware. Errors: the camera does not run, or refuses.
  Result<> trigger() override;

  LinkCounts link_counts() const override;
  std::optional<CountScale> count_scale() const override;

 protected:
  /// See set_feature(). The value is set again after each reconnection. Further error: it changes
  /// the scale of the counts after the start.
  Result<> do_set(std::string_view control, double value) override;
  /// Sensors apply exposure and gain up to 2 exposures later; one more, since the frame that is
  /// being sent began before.
  std::size_t control_delay() const override { return 3; }
  /// Errors: no such camera, or several; another host controls it; size or format not offered; a
  /// stored control that cannot be set.
  Result<StreamFormat> do_configure(const StreamRequest& request) override;
  DeviceResult<double> open_stream() override;
  DeviceResult<std::size_t> capture(TimePoint deadline) override;
  bool may_be_silent() const override { return stream_->is_starved() || triggered_; }
  void interrupt() override { stream_->wake(); }
  DeviceResult<> close_stream() override;

 private:
  using Control = std::pair<std::string, double>;

  DeviceResult<> open();
  DeviceResult<> set_up(std::string_view pixel_format, const StreamRequest& request);
  DeviceResult<> set_up_again();
  Result<> set_now(const std::string& control, double value);
  void read_features();
  FaultReport silence();
  tl::unexpected<FaultReport> lose(FaultReport fault);
  void read_clock();
  void log_clock_fit();
  void count_link();
  FrameMetadata metadata_of(const GenicamStream::Captured& captured);
  void forward_intact(const GenicamStream::Captured& captured);
  DeviceResult<std::size_t> intact_stride(const GenicamStream::Captured& captured) const;
  Result<std::shared_ptr<FrameBuffer>> frame_of(const GenicamStream::Captured& captured,
                                                std::size_t stride);

  GenicamSettings settings_;
  mutable std::mutex
      device_mutex_;  ///< guards the six members that follow, and the camera's features
  FoundCamera found_;
  OwnedObject<ArvCamera> camera_;  ///< camera while it is controlled
  bool is_set_up_ = false;         ///< format and controls are set
  std::vector<Control> controls_;  ///< stored controls, in the order of their first setting
  bool runs_ = false;
  std::optional<CountScale> count_scale_;
  GenicamStreamFormat format_;
  std::size_t buffers_ = kFreeRunningBuffers;  ///< number of the stream's buffers
  std::unique_ptr<GenicamDecoder> decoder_;    ///< decoder for formats that are not zero-copy
  std::unique_ptr<GenicamStream> stream_;      ///< stream while it is open
  bool is_lost_ = false;                       ///< a fault ended the stream
  mutable std::mutex counts_mutex_;
  LinkCounts counts_;  ///< counts of all streams
  LinkCounts ended_;   ///< counts of the streams that ended
  BlockCounter blocks_;
  DeviceClock clock_;
  std::optional<TimestampLatch> latch_;  ///< nullopt: the clock follows arrivals
  TimePoint latch_due_;
  bool is_clock_logged_ = false;                            ///< the clock of this stream was logged
  TimePoint newest_;                                        ///< stamp of the last frame
  std::atomic<bool> triggered_ = false;                     ///< the camera waits for triggers
  std::atomic<std::chrono::microseconds> exposure_time_{};  ///< exposure_time(), cached
};

}  // namespace orbwatch::hal
