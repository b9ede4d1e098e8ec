// SPDX-License-Identifier: Apache-2.0
#include "app/cli/setup/recording.h"

#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>

#include "hal/recording/camera_recording.h"

namespace orbwatch::app::cli {
namespace {

/// Records a camera until there are enough pictures. Callbacks come on the camera's thread.
class Recorder {
 public:
  Recorder(hal::Camera& camera, std::size_t count) : camera_(camera), count_(count) {}
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  ~Recorder() { camera_.stop(); }

  Result<> start() {
    const auto format = camera_.configure({.buffers = hal::kTriggeredBuffers});
    if (!format) return tl::unexpected(format.error());
    record_.format = *format;
    return camera_.start([this](const hal::Frame& frame) { keep(*frame); },
                         [this](const hal::FaultReport& report) { fail_with(report); });
  }

  Result<CameraRecord> wait(std::chrono::steady_clock::time_point deadline) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait_until(lock, deadline, [&] { return is_done(); });
    }
    camera_.stop();
    if (record_.pictures.empty()) {
      return fail(camera_.info().id + ": no picture came" + (fault_.empty() ? "" : ": " + fault_));
    }
    return std::move(record_);
  }

 private:
  bool is_done() const {
    const bool ended = !fault_.empty() && !record_.pictures.empty();
    return record_.pictures.size() >= count_ || ended;
  }

  void keep(const hal::FrameBuffer& frame) {
    const std::lock_guard lock(mutex_);
    if (is_done()) return;
    record_.pictures.push_back(copied(frame.picture, time_of(frame.metadata)));
    changed_.notify_all();
  }

  /// Folders and videos start when their camera does; their pictures belong together by number.
  std::chrono::nanoseconds time_of(const hal::FrameMetadata& metadata) const {
    const bool has_moments = camera_.info().back_end != "replay" ||
                             hal::recording::has_recording_name(camera_.info().model);
    if (has_moments) return metadata.exposure_start.time_since_epoch();
    return static_cast<std::int64_t>(metadata.sequence) * hal::period_of(record_.format.frame_rate);
  }

  void fail_with(const hal::FaultReport& report) {
    const std::lock_guard lock(mutex_);
    fault_ = report.fault == hal::Fault::None
                 ? ""
                 : std::string(operator_text(report.fault)) +
                       (report.detail.empty() ? "" : ", " + report.detail);
    changed_.notify_all();
  }

  hal::Camera& camera_;
  const std::size_t count_;
  std::mutex mutex_;  ///< guards the members below
  std::condition_variable changed_;
  CameraRecord record_;
  std::string fault_;
};

}  // namespace

std::vector<Result<CameraRecord>> record(std::span<const std::unique_ptr<hal::Camera>> cameras,
                                         std::size_t count, std::chrono::seconds patience) {
  std::vector<std::unique_ptr<Recorder>> recorders;
  std::vector<Result<>> started;
  for (const auto& camera : cameras) {
    recorders.push_back(std::make_unique<Recorder>(*camera, count));
    started.push_back(recorders.back()->start());
  }
  const auto deadline = std::chrono::steady_clock::now() + patience;
  std::vector<Result<CameraRecord>> records;
  for (std::size_t n = 0; n < recorders.size(); ++n) {
    if (started[n]) {
      records.push_back(recorders[n]->wait(deadline));
    } else {
      records.emplace_back(tl::unexpected(started[n].error()));
    }
  }
  return records;
}

}  // namespace orbwatch::app::cli
