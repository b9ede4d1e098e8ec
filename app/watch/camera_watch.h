#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/files/resolve.h"
#include "app/model/sink.h"
#include "app/model/status.h"
#include "app/pictures/picture_copy.h"
#include "app/watch/alignment_watch.h"
#include "app/watch/ball_watch.h"
#include "hal/fault.h"
#include "hal/frame/frame.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app {

/// Watches the cameras of a site beside the frame path, each on a shared thread: a picture that
/// comes while the one before is being looked at is not looked at.
/// Thread rule: as a Sink; cancel_records, figures, fault, drift, ask and record on any thread.
class CameraWatch : public Sink {
 public:
  /// Cameras that cannot be watched are named in the log.
  CameraWatch(const Resolved& site, const std::shared_ptr<hal::SharedThreads>& threads);
  ~CameraWatch() override;

  Result<> start() override { return {}; }
  void stop() override;
  std::chrono::nanoseconds cpu_time() const override;

  void accept_frames(const hal::FrameSet& set) override;
  void accept(const ViewPtr& /*view*/) override {}
  void accept(const Status& status) override;

  /// What the newest pictures said, by camera.
  std::array<CameraWatchStatus, kMaxCameras> figures() const;

  bool is_watched(std::size_t camera) const {
    return camera < cameras_.size() && cameras_[camera] != nullptr;
  }

  /// Fault of a camera, by the newest status.
  hal::Fault fault(std::size_t camera) const { return faults_[camera]; }

  /// The newest drift of a camera that is watched and was seen.
  std::optional<align::DriftState> drift(std::size_t camera) const;

  /// Has the next picture of a watched camera copied for `reader`, which is called once, on a
  /// shared thread, and must return soon. Never called after stop().
  void ask(std::size_t camera, std::function<void(RecordedPicture)> reader);

  /// Those that watch.
  std::vector<bool> is_registered_;  ///< by camera
  const std::shared_ptr<hal::SharedThreads>& threads() const { return threads_; }

  /// The ball was cleaned: its figure counts from what is seen now. For a camera that is watched.
  void learn_clean_ball(std::size_t camera) { cameras_[camera]->cleaned = true; }

  /// Waits for the next pictures of watched cameras, at most `count` of each; fewer when `patience`
  /// ends. All are of frame sets that have a new picture of each of these cameras, and those of one
  /// set have the same time. For one caller at a time. Error: one of them delivers none, or it was
  /// cancelled.
  Result<std::vector<std::vector<RecordedPicture>>> record(const std::vector<std::size_t>& cameras,
                                                           std::size_t count,
                                                           std::chrono::seconds patience);
  /// Ends record(), now and in the future.
  void cancel_records();

 private:
  /// Pictures for whoever waits for them.
  struct Records {
    std::mutex mutex;  ///< of what follows and of the cameras' records
    std::condition_variable added;
    bool is_cancelled = false;
  };

  /// One camera. `frame` and `stamp` belong to the pipeline's thread while nothing is `looking`,
  /// else to the work's.
  struct Watched {
    Watched(AlignmentWatch alignment_watch, BallWatch ball_watch, Records& all_records,
            std::shared_ptr<hal::SharedThreads> threads);
    bool can_look(const hal::FrameSet& set, std::size_t camera) const;
    void look();
    void record();
    void serve_readers();

    AlignmentWatch alignment;
    BallWatch ball;
    hal::Frame frame;
    hal::TimePoint stamp;  ///< of its frame set
    std::atomic<bool> looking{false};
    std::atomic<bool> cleaned{false};
    mutable hal::PriorityMutex mutex;  ///< of these two, held only while they are copied
    CameraWatchStatus figures;
    std::optional<align::DriftState> drift;
    std::vector<std::function<void(RecordedPicture)>> readers;  ///< under `mutex`, too
    Records& records;
    std::atomic<std::size_t> wanted{0};     ///< pictures; changed under records.mutex
    std::vector<RecordedPicture> recorded;  ///< under records.mutex
    hal::SharedThreads::Work work;
  };

  bool can_record(const hal::FrameSet& set) const;
  Result<std::unique_ptr<Watched>> make(const CameraSettings& settings, const Resolved& site,
                                        std::size_t camera, const std::filesystem::path& folder,
                                        const std::shared_ptr<hal::SharedThreads>& threads);

  const std::shared_ptr<hal::SharedThreads> threads_;
  std::array<std::atomic<hal::Fault>, kMaxCameras> faults_{};
  Records records_;
  std::vector<std::unique_ptr<Watched>> cameras_;  ///< null: not watched
};

}  // namespace orbwatch::app
