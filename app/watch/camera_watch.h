// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "app/alignment/aligned_site.h"
#include "app/alignment/watched_cameras.h"
#include "app/model/sink/sink.h"
#include "app/model/status/status.h"
#include "app/watch/alignment_watch.h"
#include "app/watch/ball_watch.h"
#include "app/watch/frame_set_copies.h"
#include "app/watch/outline_watch.h"
#include "hal/fault.h"
#include "hal/frame/frame.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app {

/// Watches the cameras of a site beside the frame path, each on a shared thread: a picture that
/// comes while the one before is being looked at is not looked at.
/// Thread rule: that of Sink and that of WatchedCameras; figures on any thread.
class CameraWatch : public Sink, public WatchedCameras {
 public:
  /// Cameras that cannot be watched are named in the log. `folder`: of what must outlast a restart.
  /// `threads` hold frames while they look at them, `outline_threads` do not.
  CameraWatch(
      const AlignedSite& site, const std::filesystem::path& folder,
      const std::shared_ptr<hal::SharedThreads>& threads,
      std::shared_ptr<hal::SharedThreads> outline_threads = hal::SharedThreads::alone("outline"));
  ~CameraWatch() override;

  Result<> start() override { return {}; }
  void stop() override;
  std::chrono::nanoseconds cpu_time() const override;

  void accept_frames(const hal::FrameSet& set) override;
  void accept(const ViewPtr& /*view*/) override {}
  void accept(const Status& status) override;

  /// Figures of the newest pictures, by camera. Those of a camera with a fault are not measured,
  /// and stay so until a picture that came after the fault was looked at; only the outline check,
  /// which is of the zero's picture, remains.
  std::array<CameraWatchStatus, kMaxCameras> figures() const;

  bool is_watched(std::size_t camera) const override {
    return camera < cameras_.size() && cameras_[camera] != nullptr;
  }

  hal::Fault fault(std::size_t camera) const override { return faults_[camera]; }
  /// The newest drift, which a fault ends as it ends the figures.
  std::optional<align::DriftState> drift(std::size_t camera) const override;
  void ask(std::size_t camera, std::function<void(RecordedPicture)> reader) override;
  void ask_together(std::vector<std::size_t> cameras, FrameSetCopies::Reader reader) override {
    copies_.ask(std::move(cameras), std::move(reader));
  }
  Result<std::vector<std::vector<RecordedPicture>>> record(
      const std::vector<std::size_t>& cameras, std::size_t count, std::chrono::seconds patience,
      const align::WorkProgress& progress) override;
  const std::shared_ptr<hal::SharedThreads>& threads() const override { return threads_; }

  /// The ball was cleaned: its figure counts from what is seen now. For a camera that is watched.
  void learn_clean_ball(std::size_t camera) { cameras_[camera]->cleaned = true; }

 private:
  /// Pictures for callers of record().
  struct Records {
    std::mutex mutex;  ///< guards the members below and the cameras' records
    std::condition_variable_any added;
  };

  /// One camera. `frame` and `stamp` belong to the pipeline's thread while nothing is `looking`,
  /// else to the work's.
  struct Watched {
    Watched(const std::string& name, AlignmentWatch alignment_watch, BallWatch ball_watch,
            Records& all_records, std::shared_ptr<hal::SharedThreads> threads,
            std::shared_ptr<hal::SharedThreads> outline_threads);
    bool can_look(const hal::FrameSet& set, std::size_t camera) const;
    void look();
    void forget();
    void record();
    void serve_readers();

    AlignmentWatch alignment;
    OutlineWatch outline;
    BallWatch ball;
    hal::Frame frame;
    hal::TimePoint stamp;  ///< its frame set's
    std::atomic<bool> looking{false};
    std::atomic<bool> cleaned{false};
    mutable hal::PriorityMutex mutex;  ///< guards these two, held only while they are copied
    CameraWatchStatus figures;
    std::optional<align::DriftState> drift;
    std::atomic<bool> is_outdated{false};  ///< a fault came after `frame`; set under `mutex`, too
    std::vector<std::function<void(RecordedPicture)>> readers;  ///< under `mutex`, too
    Records& records;
    std::atomic<std::size_t> wanted{0};     ///< pictures; changed under records.mutex
    std::vector<RecordedPicture> recorded;  ///< under records.mutex
    hal::SharedThreads::Work work;
  };

  bool can_record(const hal::FrameSet& set) const;
  Result<std::unique_ptr<Watched>> make(const AlignedSite& site, std::size_t camera,
                                        const std::filesystem::path& folder);

  const std::shared_ptr<hal::SharedThreads> threads_;
  const std::shared_ptr<hal::SharedThreads> outline_threads_;
  std::array<std::atomic<hal::Fault>, kMaxCameras> faults_{};
  Records records_;
  FrameSetCopies copies_;
  std::vector<bool> is_registered_;                ///< one per camera
  std::vector<std::unique_ptr<Watched>> cameras_;  ///< null: not watched
};

}  // namespace orbwatch::app
