// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "app/alignment/aligned_site.h"
#include "app/alignment/alignment_finder.h"
#include "app/alignment/alignment_pictures.h"
#include "app/alignment/stated_alignment.h"
#include "app/alignment/watched_cameras.h"
#include "app/model/alignment/accepted_alignments.h"
#include "app/model/alignment/alignment.h"
#include "app/model/command/command.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app {

/// Checks that an alignment accepted now would be in force after a restart. Error: why not.
/// Waits for the checks of a whole configuration. On any thread.
using AcceptanceCheck = std::function<Result<>(const CalibrationEntry&)>;

/// Finds new alignments of a running site's cameras on command, changes them, and puts those that
/// are accepted in force: an entry in the file of calibrations, and a restart. What is found or
/// stated builds on the camera's proposal, if there is one, and is a step that can be taken back.
/// Finding takes seconds, one camera at a time, on a thread of its own, and can be cancelled:
/// nothing of it is kept, and another one may begin at once. Cameras whose settings ask for it are
/// corrected without a command when their drift lasts, not more often than each
/// kPauseOfCorrections.
/// Thread rule: start and stop on the owner's thread, the rest on any.
class AlignmentDesk : public AlignmentSource {
 public:
  static constexpr std::chrono::seconds kLastingDrift{10};
  static constexpr std::chrono::minutes kPauseOfCorrections{10};
  /// Older steps are forgotten.
  static constexpr std::size_t kMostSteps = 200;

  /// The first three outlive it. `restart` requests it and returns.
  AlignmentDesk(const AlignedSite& site, WatchedCameras& watch, AcceptedAlignments& accepted,
                std::function<void()> restart, AcceptanceCheck check_acceptance);
  ~AlignmentDesk() override;

  // Commands. ArgumentOutOfRange: no such camera; Busy: another one is being found;
  // NotPossible: see each.

  /// Finds the ball in the camera's next picture. NotPossible: it is not watched.
  CommandResult detect(std::size_t camera);
  /// Registers it to the first camera by what both see in the next seconds. NotPossible: it is the
  /// first one, or one of them is not watched.
  CommandResult register_to_first(std::size_t camera);
  /// Takes its drift for its alignment. NotPossible: it is not watched.
  CommandResult correct(std::size_t camera);
  /// Adds a point to place the camera by, at the pixel that was picked, or where its ball shows the
  /// tool's light now. NotPossible: it is not watched.
  CommandResult mark(std::size_t camera, const optics::Vec3& point);
  /// Says where the picture shows the point that is marked next. ArgumentOutOfRange: outside of the
  /// ball, too.
  CommandResult pick(std::size_t camera, const optics::Vec2& pixel);
  /// Forgets the point with these coordinates. NotPossible: there is none.
  CommandResult forget_point(std::size_t camera, const optics::Vec3& point);
  /// Forgets all points. NotPossible: there are none.
  CommandResult forget_points(std::size_t camera);
  /// Places it by its points and the site's tags. NotPossible: it is not watched, or there are
  /// neither.
  CommandResult place(std::size_t camera);

  /// Cancels what one of these commands began for the camera. NotPossible: it has ended.
  CommandResult cancel(std::size_t camera);

  // States an alignment. ArgumentOutOfRange: also one that cannot be; the report says why.

  CommandResult move_outline(std::size_t camera, const optics::Vec2& centre);
  CommandResult shape_outline(std::size_t camera, double rx, double ry, double angle);
  /// About the ball, as a turn in the machine frame.
  CommandResult turn(std::size_t camera, const optics::YawPitchRoll& turn);

  /// Takes the last step back. NotPossible: there is none.
  CommandResult undo(std::size_t camera);
  /// Puts the proposal in force. NotPossible: there is none, the last finding was refused, or it
  /// would not be in force after the restart; the report says why.
  CommandResult accept(std::size_t camera);
  /// Puts what counted before in force. NotPossible: the rig file counts, or as of accept().
  CommandResult revert(std::size_t camera);
  /// Forgets the proposal. NotPossible: there is none.
  CommandResult discard(std::size_t camera);

  /// Sets the figures of proposals and points.
  void report(std::array<CameraWatchStatus, kMaxCameras>& figures) const;

  AlignmentReport report(std::size_t camera) const override;
  std::optional<optics::Vec3> direction(std::size_t camera,
                                        const optics::Vec2& pixel) const override;
  Result<> request(const AlignmentPicture& picture, OnPictures on_pictures,
                   IsWanted is_wanted) override;

  /// Begins to correct cameras whose settings ask for that.
  void start();
  void stop();

 private:
  using Task =
      std::function<Result<Found>(const optics::Rig& rig, const align::WorkProgress& progress)>;

  using Method = Result<Found> (AlignmentFinder::*)(const optics::Rig& rig, std::size_t camera,
                                                    const align::WorkProgress& progress) const;

  /// Proposals for one camera, under mutex_.
  struct Desk {
    std::vector<AlignmentProposal> steps;  ///< the last one counts
    std::string refusal;
    std::optional<optics::Vec2> picked;
  };

  /// Computation that a command has begun.
  struct Work {
    std::size_t camera;
    Task task;
    optics::Rig rig;
    std::stop_source stop{};
    align::WorkStep step = align::WorkStep::None;  ///< under mutex_
    double share = 0;                              ///< of the step; under mutex_
  };

  bool has(std::size_t camera) const { return camera < site_.cameras.size(); }
  const std::string& name(std::size_t camera) const { return site_.cameras[camera].name; }
  Result<std::vector<optics::BallProjection>> balls_of(const AlignmentPicture& picture) const;

  Task task_of(Method method, std::size_t camera) const;
  CommandResult begin(std::size_t camera, bool is_possible, Task task);
  void work();
  void keep(const std::shared_ptr<Work>& work, Result<Found> found);
  CommandResult state(std::size_t camera, const std::string& method, const AlignmentChange& change);
  CommandResult put_in_force(std::size_t camera, const CalibrationEntry& entry);
  CommandResult refuse(std::size_t camera, const std::string& why, CommandResult result);
  bool is_new_refusal(std::size_t camera, const std::string& why);
  /// The camera's state in `rig`, which the proposal `step` makes.
  std::optional<CameraAlignmentState> proposed_state(const AlignmentProposal& step,
                                                     const optics::Rig& rig,
                                                     std::size_t camera) const;
  void correct_lasting_drifts();
  void correct_lasting_drift(std::size_t camera, hal::TimePoint now);

  // Under mutex_.
  Result<optics::Rig> proposed_rig(std::size_t camera) const;
  Result<optics::BallProjection> proposed_ball(std::size_t camera) const;
  std::string add_step(std::size_t camera, AlignmentProposal proposal);
  void show_steps(std::size_t camera);
  void forget_proposal(std::size_t camera);

  const AlignedSite& site_;
  WatchedCameras& watch_;
  AcceptedAlignments& accepted_;  ///< changed by the caller that has set busy_
  const std::function<void()> restart_;
  const AcceptanceCheck check_acceptance_;
  AlignmentFinder finder_;
  AlignmentPictures pictures_;
  std::array<std::atomic<ProposalState>, kMaxCameras> states_{};
  std::array<std::atomic<double>, kMaxCameras> direction_sigmas_{};  ///< proposals'; degrees
  std::array<std::atomic<std::size_t>, kMaxCameras> point_counts_{};
  mutable std::mutex mutex_;  ///< guards the members below
  std::array<Desk, kMaxCameras> desks_;
  std::optional<std::size_t> busy_;  ///< the camera that is worked for
  std::shared_ptr<Work> wanted_;     ///< waits or runs, and is not cancelled; null: none
  bool is_stopped_ = false;
  std::array<std::optional<hal::TimePoint>, kMaxCameras> drifting_since_;  ///< the correction's
  /// Others must not wait for seconds.
  const std::shared_ptr<hal::SharedThreads> thread_ = hal::SharedThreads::alone("alignment");
  hal::SharedThreads::Work work_;
  hal::SharedThreads::Work correction_;
};

}  // namespace orbwatch::app
