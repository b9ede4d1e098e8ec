// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_desk.h"

#include <algorithm>
#include <utility>

#include "app/alignment/alignment_state.h"
#include "app/alignment/drift_correction.h"
#include "app/alignment/figure_text.h"
#include "app/alignment/work_bound.h"
#include "app/log.h"
#include "hal/fault.h"

namespace orbwatch::app {

AlignmentDesk::AlignmentDesk(const AlignedSite& site, WatchedCameras& watch,
                             AcceptedAlignments& accepted, std::function<void()> restart,
                             AcceptanceCheck check_acceptance)
    : site_(site),
      watch_(watch),
      accepted_(accepted),
      restart_(std::move(restart)),
      check_acceptance_(std::move(check_acceptance)),
      finder_(site, watch),
      pictures_(watch),
      work_(thread_, [this] { work(); }),
      correction_(thread_, [this] { correct_lasting_drifts(); }) {
  for (auto& sigma : direction_sigmas_) sigma = signals::kNotValid;
}

AlignmentDesk::~AlignmentDesk() { stop(); }

void AlignmentDesk::start() {
  const auto corrects = [](const AlignedCamera& camera) {
    return camera.watch.enabled && camera.watch.correct;
  };
  if (std::ranges::any_of(site_.cameras, corrects)) correction_.request();
}

void AlignmentDesk::stop() {
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    if (wanted_) wanted_->stop.request_stop();
  }
  correction_.cancel();
  work_.cancel();
  pictures_.stop();
}

AlignmentDesk::Task AlignmentDesk::task_of(Method method, std::size_t camera) const {
  return [this, method, camera](const optics::Rig& rig, const align::WorkProgress& progress) {
    return (finder_.*method)(rig, camera, progress);
  };
}

CommandResult AlignmentDesk::detect(std::size_t camera) {
  return begin(camera, watch_.is_watched(camera), task_of(&AlignmentFinder::detect, camera));
}

CommandResult AlignmentDesk::register_to_first(std::size_t camera) {
  const bool is_possible = camera != 0 && watch_.is_watched(camera) && watch_.is_watched(0);
  return begin(camera, is_possible, task_of(&AlignmentFinder::register_to_first, camera));
}

CommandResult AlignmentDesk::correct(std::size_t camera) {
  const auto task = [this, camera](const auto&, const auto&) -> Result<Found> {
    const hal::Fault fault = watch_.fault(camera);
    if (fault == hal::Fault::None) return finder_.correct(camera);
    return fail("there is no picture: " + std::string(operator_text(fault)));
  };
  return begin(camera, watch_.is_watched(camera), task);
}

CommandResult AlignmentDesk::mark(std::size_t camera, const optics::Vec3& point) {
  const auto task = [this, camera, point](const auto& rig, const auto& progress) {
    std::optional<optics::Vec2> picked;
    {
      const std::lock_guard lock(mutex_);
      picked = std::exchange(desks_[camera].picked, std::nullopt);
    }
    return finder_.mark(rig, camera, point, picked, progress);
  };
  return begin(camera, watch_.is_watched(camera), task);
}

CommandResult AlignmentDesk::pick(std::size_t camera, const optics::Vec2& pixel) {
  if (!has(camera)) return CommandResult::ArgumentOutOfRange;
  const std::lock_guard lock(mutex_);
  const auto ball = proposed_ball(camera);
  if (!ball || !ball->ray(pixel)) return CommandResult::ArgumentOutOfRange;
  desks_[camera].picked = pixel;
  return CommandResult::Done;
}

CommandResult AlignmentDesk::place(std::size_t camera) {
  const bool is_possible =
      watch_.is_watched(camera) && (point_counts_[camera] > 0 || !site_.place.tags.empty());
  return begin(camera, is_possible, task_of(&AlignmentFinder::place, camera));
}

CommandResult AlignmentDesk::forget_point(std::size_t camera, const optics::Vec3& point) {
  if (!has(camera)) return CommandResult::ArgumentOutOfRange;
  const std::lock_guard lock(mutex_);
  if (busy_) return CommandResult::Busy;
  if (!finder_.forget_point(camera, point)) return CommandResult::NotPossible;
  point_counts_[camera] = finder_.points(camera).size();
  return CommandResult::Done;
}

CommandResult AlignmentDesk::forget_points(std::size_t camera) {
  if (!has(camera)) return CommandResult::ArgumentOutOfRange;
  const std::lock_guard lock(mutex_);
  if (busy_) return CommandResult::Busy;
  if (point_counts_[camera] == 0) return CommandResult::NotPossible;
  finder_.forget_points(camera);
  point_counts_[camera] = 0;
  return CommandResult::Done;
}

CommandResult AlignmentDesk::begin(std::size_t camera, bool is_possible, Task task) {
  if (!has(camera)) return CommandResult::ArgumentOutOfRange;
  if (!is_possible) return CommandResult::NotPossible;
  {
    const std::lock_guard lock(mutex_);
    if (busy_ || is_stopped_) return CommandResult::Busy;
    auto rig = proposed_rig(camera);
    if (!rig) return CommandResult::NotPossible;
    busy_ = camera;
    wanted_ = std::make_shared<Work>(Work{camera, std::move(task), std::move(*rig)});
    desks_[camera].refusal.clear();
    states_[camera] = ProposalState::Working;
  }
  work_.request();
  return CommandResult::Done;
}

CommandResult AlignmentDesk::cancel(std::size_t camera) {
  if (!has(camera)) return CommandResult::ArgumentOutOfRange;
  {
    const std::lock_guard lock(mutex_);
    if (!wanted_ || wanted_->camera != camera) return CommandResult::NotPossible;
    wanted_->stop.request_stop();
    wanted_.reset();
    busy_.reset();
    show_steps(camera);
  }
  log_camera(LogLevel::Info, name(camera), "its alignment is cancelled: nothing is changed");
  return CommandResult::Done;
}

/// Cancelled work that still runs delays the next one, and nothing else.
void AlignmentDesk::work() {
  std::shared_ptr<Work> work;
  {
    const std::lock_guard lock(mutex_);
    work = wanted_;
  }
  if (!work) return;  // cancelled before it began
  const auto on_step = [&](align::WorkStep step, double share) {
    const std::lock_guard lock(mutex_);
    work->step = step;
    work->share = share;
  };
  keep(work, work->task(work->rig, align::WorkProgress(on_step, work->stop.get_token())));
}

void AlignmentDesk::keep(const std::shared_ptr<Work>& work, Result<Found> found) {
  const std::size_t camera = work->camera;
  const std::string refusal = found ? found->refusal : found.error().message;
  std::string said;
  {
    const std::lock_guard lock(mutex_);
    if (wanted_ != work || is_stopped_) return;  // cancelled
    wanted_.reset();
    busy_.reset();
    if (found && found->points) {
      point_counts_[camera] = found->points->marks.size();
      finder_.set_points(camera, std::move(*found->points));
    }
    if (!refusal.empty()) {
      states_[camera] = ProposalState::Refused;
      desks_[camera].refusal = refusal;
      said = "nothing found: " + refusal;
    } else if (found->proposal) {
      said = add_step(camera, std::move(*found->proposal));
    } else {
      show_steps(camera);
      said = "a point is marked, of " + std::to_string(point_counts_[camera]) + " for place_camera";
    }
  }
  log_camera(refusal.empty() ? LogLevel::Info : LogLevel::Warning, name(camera), said);
}

/// The rig that an acceptance of the camera's proposal would put in force.
Result<optics::Rig> AlignmentDesk::proposed_rig(std::size_t camera) const {
  optics::Rig rig = site_.rig;
  const std::vector<AlignmentProposal>& steps = desks_[camera].steps;
  if (steps.empty()) return rig;
  return apply({.cameras = {steps.back().alignment}}, rig).map([&] { return rig; });
}

Result<optics::BallProjection> AlignmentDesk::proposed_ball(std::size_t camera) const {
  return proposed_rig(camera).and_then([&](const optics::Rig& rig) {
    return optics::ball_projection(rig, site_.camera_of(rig, camera));
  });
}

/// Returns what the log is to say of it once mutex_ is free: others wait for that.
std::string AlignmentDesk::add_step(std::size_t camera, AlignmentProposal proposal) {
  std::vector<AlignmentProposal>& steps = desks_[camera].steps;
  const double work_sigma = site_.work_sigma(proposal.direction_sigma);
  if (signals::is_valid(work_sigma)) {
    proposal.quality += ", " + figure_text("at the work piece", work_sigma, "mm") + ", " +
                        figure_text("below", work_bound(work_sigma), "mm in 19 of 20 alignments");
  }
  std::string said = "an alignment is proposed: " + proposal.method + ", " + proposal.quality +
                     "; accept_alignment puts it in force, with a restart";
  if (steps.size() == kMostSteps) steps.erase(steps.begin());
  steps.push_back(std::move(proposal));
  show_steps(camera);
  return said;
}

/// In the figures.
void AlignmentDesk::show_steps(std::size_t camera) {
  const std::vector<AlignmentProposal>& steps = desks_[camera].steps;
  direction_sigmas_[camera] = steps.empty() ? signals::kNotValid : steps.back().direction_sigma;
  states_[camera] = steps.empty() ? ProposalState::None : ProposalState::Ready;
}

void AlignmentDesk::forget_proposal(std::size_t camera) {
  desks_[camera].steps.clear();
  desks_[camera].refusal.clear();
  show_steps(camera);
}

CommandResult AlignmentDesk::move_outline(std::size_t camera, const optics::Vec2& centre) {
  return state(
      camera, "outline by hand",
      [&](optics::Outline& outline, std::optional<optics::Mat3>&) { outline.centre = centre; });
}

CommandResult AlignmentDesk::shape_outline(std::size_t camera, double rx, double ry, double angle) {
  return state(camera, "outline by hand",
               [&](optics::Outline& outline, std::optional<optics::Mat3>&) {
                 outline = {outline.centre, rx, ry, angle};
               });
}

CommandResult AlignmentDesk::turn(std::size_t camera, const optics::YawPitchRoll& turn) {
  return state(camera, "turned by hand",
               [&](optics::Outline&, std::optional<optics::Mat3>& registration) {
                 registration = optics::rotation(turn) * registration.value_or(optics::Mat3{});
               });
}

CommandResult AlignmentDesk::state(std::size_t camera, const std::string& method,
                                   const AlignmentChange& change) {
  if (!has(camera)) return CommandResult::ArgumentOutOfRange;
  std::string said;
  {
    const std::lock_guard lock(mutex_);
    if (busy_) return CommandResult::Busy;
    auto proposal = proposed_rig(camera).and_then([&](const optics::Rig& rig) {
      return stated_alignment(rig, site_.camera_of(rig, camera), method, change);
    });
    if (!proposal) {
      desks_[camera].refusal = proposal.error().message;
      return CommandResult::ArgumentOutOfRange;
    }
    desks_[camera].refusal.clear();
    said = add_step(camera, std::move(*proposal));
  }
  log_camera(LogLevel::Info, name(camera), said);
  return CommandResult::Done;
}

CommandResult AlignmentDesk::undo(std::size_t camera) {
  if (!has(camera)) return CommandResult::ArgumentOutOfRange;
  const std::lock_guard lock(mutex_);
  if (busy_ == camera) return CommandResult::Busy;
  Desk& desk = desks_[camera];
  const bool was_refused = states_[camera] == ProposalState::Refused;
  if (!was_refused && desk.steps.empty()) return CommandResult::NotPossible;
  if (!was_refused) desk.steps.pop_back();
  desk.refusal.clear();
  show_steps(camera);
  return CommandResult::Done;
}

CommandResult AlignmentDesk::discard(std::size_t camera) {
  if (!has(camera)) return CommandResult::ArgumentOutOfRange;
  const std::lock_guard lock(mutex_);
  if (busy_ == camera) return CommandResult::Busy;
  if (states_[camera] == ProposalState::None) return CommandResult::NotPossible;
  forget_proposal(camera);
  return CommandResult::Done;
}

CommandResult AlignmentDesk::accept(std::size_t camera) {
  if (!has(camera)) return CommandResult::ArgumentOutOfRange;
  CalibrationEntry entry;
  {
    const std::lock_guard lock(mutex_);
    if (busy_) return CommandResult::Busy;
    if (states_[camera] != ProposalState::Ready) return CommandResult::NotPossible;
    entry = entry_of(desks_[camera].steps.back());
    busy_ = camera;
  }
  return put_in_force(camera, entry);
}

CommandResult AlignmentDesk::revert(std::size_t camera) {
  if (!has(camera)) return CommandResult::ArgumentOutOfRange;
  {
    const std::lock_guard lock(mutex_);
    if (busy_) return CommandResult::Busy;
    busy_ = camera;
  }
  const auto before = accepted_.before(name(camera));
  if (before && *before) return put_in_force(camera, **before);
  if (!before) {
    return refuse(camera, "not reverted: " + before.error().message, CommandResult::NotCarriedOut);
  }
  const std::lock_guard lock(mutex_);
  busy_.reset();
  return CommandResult::NotPossible;
}

/// For the caller who has set busy_, which is reset.
CommandResult AlignmentDesk::refuse(std::size_t camera, const std::string& why,
                                    CommandResult result) {
  log_camera(LogLevel::Error, name(camera), why);
  const std::lock_guard lock(mutex_);
  busy_.reset();
  desks_[camera].refusal = why;
  return result;
}

/// The log says what repeats itself once.
bool AlignmentDesk::is_new_refusal(std::size_t camera, const std::string& why) {
  const std::lock_guard lock(mutex_);
  return std::exchange(desks_[camera].refusal, why) != why;
}

/// For the caller who has set busy_, which is reset.
CommandResult AlignmentDesk::put_in_force(std::size_t camera, const CalibrationEntry& entry) {
  if (const auto allowed = check_acceptance_(entry); !allowed) {
    return refuse(camera, "not accepted: " + allowed.error().message, CommandResult::NotPossible);
  }
  const auto number = accepted_.add(entry);
  if (!number) {
    return refuse(camera, "not accepted: " + number.error().message, CommandResult::NotCarriedOut);
  }
  log_camera(LogLevel::Info, name(camera),
             "alignment " + std::to_string(*number) + " is accepted; restarts with it");
  {
    const std::lock_guard lock(mutex_);
    busy_.reset();
    forget_proposal(camera);
  }
  restart_();
  return CommandResult::Done;
}

void AlignmentDesk::correct_lasting_drifts() {
  const auto now = hal::Clock::now();
  for (std::size_t i = 0; i < site_.cameras.size(); ++i) {
    if (site_.cameras[i].watch.correct) correct_lasting_drift(i, now);
  }
  correction_.request(now + std::chrono::seconds(1));
}

void AlignmentDesk::correct_lasting_drift(std::size_t camera, hal::TimePoint now) {
  const auto drift = watch_.drift(camera);
  if (!drift || drift->level < align::DriftLevel::Warning) {
    drifting_since_[camera].reset();
    return;
  }
  if (!drifting_since_[camera]) drifting_since_[camera] = now;
  if (now - *drifting_since_[camera] < kLastingDrift ||
      accepted_.is_young(name(camera), kPauseOfCorrections)) {
    return;
  }
  auto corrected = finder_.correct(camera);
  if (!corrected) return;
  const CalibrationEntry entry = entry_of(*corrected->proposal);
  if (const auto allowed = check_acceptance_(entry); !allowed) {
    drifting_since_[camera].reset();  // not each second
    const std::string why = "its drift is not corrected: " + allowed.error().message;
    if (is_new_refusal(camera, why)) log_camera(LogLevel::Warning, name(camera), why);
    return;
  }
  std::string said;
  {
    const std::lock_guard lock(mutex_);
    if (busy_) return;
    busy_ = camera;  // nobody adds a step to this one before it is in force
    said = add_step(camera, std::move(*corrected->proposal));
  }
  log_camera(LogLevel::Info, name(camera), said);
  // One that is refused is not found again each second.
  if (put_in_force(camera, entry) != CommandResult::Done) drifting_since_[camera].reset();
}

void AlignmentDesk::report(std::array<CameraWatchStatus, kMaxCameras>& figures) const {
  for (std::size_t i = 0; i < figures.size(); ++i) {
    figures[i].proposal = states_[i];
    figures[i].proposal_error = direction_sigmas_[i];
    figures[i].marked_points = point_counts_[i];
  }
}

AlignmentReport AlignmentDesk::report(std::size_t camera) const {
  AlignmentReport report;
  if (!has(camera)) return report;
  std::optional<optics::Rig> rig;
  std::optional<AlignmentProposal> step;
  {
    const std::lock_guard lock(mutex_);
    const Desk& desk = desks_[camera];
    report.state = states_[camera];
    report.refusal = desk.refusal;
    report.steps = desk.steps.size();
    report.picked = desk.picked;
    if (wanted_ && wanted_->camera == camera) {
      report.step = wanted_->step;
      report.share = wanted_->share;
    }
    if (!desk.steps.empty()) step = desk.steps.back();
    if (const auto proposed = proposed_rig(camera); step && proposed) rig = *proposed;
  }
  report.width = site_.rig_camera(camera).width;
  report.height = site_.rig_camera(camera).height;
  report.is_watched = watch_.is_watched(camera);
  report.points = finder_.points(camera);
  report.in_force = alignment_in_force(site_, camera);
  if (rig) report.proposed = proposed_state(*step, *rig, camera);
  return report;
}

std::optional<CameraAlignmentState> AlignmentDesk::proposed_state(const AlignmentProposal& step,
                                                                  const optics::Rig& rig,
                                                                  std::size_t camera) const {
  auto state = alignment_state(rig, site_.camera_of(rig, camera));
  if (!state) return std::nullopt;
  state->method = step.method;
  state->quality = step.quality;
  state->direction_sigma = step.direction_sigma;
  state->work_sigma = site_.work_sigma(step.direction_sigma);
  return std::move(*state);
}

std::optional<optics::Vec3> AlignmentDesk::direction(std::size_t camera,
                                                     const optics::Vec2& pixel) const {
  if (!has(camera)) return std::nullopt;
  const std::lock_guard lock(mutex_);
  const auto ball = proposed_ball(camera);
  return ball ? ball->direction(pixel) : std::nullopt;
}

Result<std::vector<optics::BallProjection>> AlignmentDesk::balls_of(
    const AlignmentPicture& picture) const {
  std::vector<optics::BallProjection> balls;
  const auto add = [&](const optics::Rig& rig, std::size_t camera) {
    optics::RigCamera own = site_.camera_of(rig, camera);
    if (picture.model) own.model = *picture.model;
    return optics::ball_projection(rig, own).map(
        [&](optics::BallProjection ball) { balls.push_back(std::move(ball)); });
  };
  if (picture.is_beside_first) {
    if (const auto added = add(site_.rig, 0); !added) return tl::unexpected(added.error());
  }
  optics::Rig rig = site_.rig;
  if (picture.is_proposed) {
    const std::lock_guard lock(mutex_);
    auto proposed = proposed_rig(picture.camera);
    if (!proposed) return tl::unexpected(proposed.error());
    rig = std::move(*proposed);
  }
  return add(rig, picture.camera).map([&] { return std::move(balls); });
}

Result<> AlignmentDesk::request(const AlignmentPicture& picture, OnPictures on_pictures,
                                IsWanted is_wanted) {
  if (!has(picture.camera)) return fail("there is no camera " + std::to_string(picture.camera));
  if (picture.is_beside_first && picture.camera == 0) {
    return fail("it is the first camera, which others are compared with");
  }
  return balls_of(picture).and_then([&](std::vector<optics::BallProjection> balls) {
    return pictures_.request(picture, std::move(balls), std::move(on_pictures),
                             std::move(is_wanted));
  });
}

}  // namespace orbwatch::app
