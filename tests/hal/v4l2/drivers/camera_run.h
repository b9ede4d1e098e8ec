// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "hal/v4l2/v4l2_camera.h"

namespace orbwatch::hal {

/// Running camera, with all its frames and reports. Emulated machines are slow: a wait ends with
/// the expected event, or after minutes.
class CameraRun {
 public:
  using Controls = std::vector<std::pair<const char*, double>>;

  explicit CameraRun(
      V4l2Settings settings, const Controls& controls = {},
      DmaBufferSources sources = [] { return dma_heaps(); })
      : camera_(std::move(settings), std::move(sources)) {
    camera_.set_on_notice([this](const std::string& text) {
      const std::lock_guard lock(mutex_);
      notice_ = text;
    });
    for (const auto& [name, value] : controls) {
      const auto set = camera_.set(name, value);
      EXPECT_TRUE(set) << set.error().message;
    }
  }
  ~CameraRun() { camera_.stop(); }

  V4l2Camera& camera() { return camera_; }

  /// Configures and starts; false, and a failure, when the camera refuses.
  bool start(const StreamRequest& request) {
    const auto format = camera_.configure(request);
    EXPECT_TRUE(format) << format.error().message;
    if (!format) return false;
    format_ = *format;
    const auto started = camera_.start([this](const Frame& frame) { on_frame(frame); },
                                       [this](const FaultReport& report) { on_fault(report); });
    EXPECT_TRUE(started);
    return started.has_value();
  }
  const StreamFormat& format() const { return format_; }

  /// Waits for the next frame; null when none comes.
  Frame next_frame() {
    std::unique_lock lock(mutex_);
    newest_ = nullptr;
    changed_.wait_for(lock, kMaxWait, [this] { return newest_ != nullptr; });
    return newest_;
  }

  /// Waits until a state is reported that no earlier call has returned; false when it is not.
  bool reports(Fault fault) {
    std::unique_lock lock(mutex_);
    const bool came = changed_.wait_for(lock, kMaxWait, [&] {
      while (seen_ < reports_.size()) {
        if (reports_[seen_++].fault == fault) return true;
      }
      return false;
    });
    for (const auto& report : reports_) {
      if (!came) ADD_FAILURE() << operator_text(report.fault) << ": " << report.detail;
    }
    return came;
  }

  /// Newest notice.
  std::string notice() {
    const std::lock_guard lock(mutex_);
    return notice_;
  }

  bool has_reported() {
    const std::lock_guard lock(mutex_);
    return !reports_.empty();
  }

  /// Releases the held frame.
  void release() {
    const std::lock_guard lock(mutex_);
    newest_ = nullptr;
  }

 private:
  static constexpr std::chrono::seconds kMaxWait{90};

  void on_frame(const Frame& frame) {
    const std::lock_guard lock(mutex_);
    newest_ = frame;
    changed_.notify_all();
  }
  void on_fault(const FaultReport& report) {
    const std::lock_guard lock(mutex_);
    reports_.push_back(report);
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  Frame newest_;
  std::string notice_;
  std::vector<FaultReport> reports_;
  std::size_t seen_ = 0;
  StreamFormat format_;
  V4l2Camera camera_;
};

}  // namespace orbwatch::hal
