#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/files/resolve.h"
#include "app/model/command.h"
#include "app/model/status.h"
#include "app/watch/camera_watch.h"
#include "app/watch/point_marks.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app {

/// Finds new alignments of a running site's cameras on command, and puts those that are accepted
/// in force: an entry in the file of calibrations, and a restart. One at a time; each takes
/// seconds, on a thread of its own. Cameras whose settings ask for it are corrected without a
/// command when their drift lasts, not more often than each kPauseOfCorrections.
/// Thread rule: start and stop on the owner's thread, the rest on any.
class AlignmentDesk {
 public:
  static constexpr std::chrono::seconds kLastingDrift{10};
  static constexpr std::chrono::minutes kPauseOfCorrections{10};

  /// `watch` outlives it. `restart` requests it and returns.
  AlignmentDesk(const Resolved& site, CameraWatch& watch, std::function<void()> restart);
  ~AlignmentDesk();

  // Commands. ArgumentOutOfRange: no such camera; Busy: another one is being found;
  // NotPossible: see each.

  /// Finds the ball in the camera's next picture. NotPossible: it is not watched.
  CommandResult detect(std::size_t camera);
  /// Registers it to the first camera by what both see in the next second. NotPossible: it is the
  /// first one, or one of them is not watched.
  CommandResult register_to_first(std::size_t camera);
  /// Takes its drift for its alignment. NotPossible: it is not watched.
  CommandResult correct(std::size_t camera);
  /// Adds a point to place the camera by, where its ball shows the tool's light now; a proposal is
  /// forgotten. NotPossible: it is not watched.
  CommandResult mark(std::size_t camera, const optics::Vec3& point);
  /// Forgets all of them. NotPossible: there are none.
  CommandResult forget_points(std::size_t camera);
  /// Places it by its points and the site's tags. NotPossible: it is not watched, or there are
  /// neither.
  CommandResult place(std::size_t camera);
  /// Puts what was found in force. NotPossible: nothing was.
  CommandResult accept(std::size_t camera);
  /// Forgets it. NotPossible: nothing was found.
  CommandResult discard(std::size_t camera);

  /// Sets the figures of proposals and points.
  void report(std::array<CameraWatchStatus, kMaxCameras>& figures) const;

  /// Begins to correct cameras whose settings ask for that.
  void start();
  void stop();

 private:
  struct Proposal {
    CalibrationEntry entry;
    double direction_sigma = signals::kNotValid;  ///< degrees
  };
  using Finding = Result<std::optional<Proposal>>;  ///< none: a point was marked
  using Task = std::function<Finding()>;

  CommandResult begin(std::size_t camera, bool is_possible, Task task);
  void work();
  void correct_lasting_drifts();
  void correct_lasting_drift(std::size_t camera, hal::TimePoint now);
  Result<Proposal> detected(std::size_t camera) const;
  Result<Proposal> registered(std::size_t camera) const;
  Result<Proposal> drifted(std::size_t camera) const;
  Finding marked(std::size_t camera, const optics::Vec3& point);
  Result<Proposal> placed(std::size_t camera) const;
  Result<align::PlaceRequest> place_request(std::size_t camera) const;
  CalibrationEntry entry(const CameraAlignment& alignment) const;
  void forget_proposal(std::size_t camera);
  const std::string& name(std::size_t camera) const { return site_.site.cameras[camera].name; }

  const Resolved& site_;
  CameraWatch& watch_;
  const std::function<void()> restart_;
  std::array<std::atomic<ProposalState>, kMaxCameras> states_{};
  std::array<std::atomic<double>, kMaxCameras> direction_sigmas_{};  ///< of the proposals
  std::array<std::atomic<std::size_t>, kMaxCameras> point_counts_{};
  std::array<PointMarks, kMaxCameras> points_;  ///< the task's while there is one
  std::mutex mutex_;  ///< of what follows; also while accept() writes the file
  std::array<std::optional<CalibrationEntry>, kMaxCameras> proposals_;
  std::optional<std::size_t> busy_;  ///< the camera that is worked for
  Task task_;
  std::array<std::optional<hal::TimePoint>, kMaxCameras> drifting_since_;  ///< the correction's
  /// Others must not wait for seconds.
  const std::shared_ptr<hal::SharedThreads> thread_ =
      std::make_shared<hal::SharedThreads>("alignment", hal::ThreadRole::Background, 1);
  hal::SharedThreads::Work work_;
  hal::SharedThreads::Work correction_;
};

}  // namespace orbwatch::app
