// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/drift_monitor.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "proc/align/drift/ball_tracker.h"
#include "proc/align/drift/camera_turn.h"
#include "proc/align/drift/fault.h"
#include "proc/align/drift/motion_statistics.h"
#include "proc/align/drift/reference_picture.h"
#include "proc/align/drift/view_error.h"

namespace orbwatch::align {
namespace {

using optics::Outline;
using Time = DriftMonitor::Time;

/// Smallest radius of a ball with enough pixels around its limb, px.
constexpr double kSmallestTracked = 24;
/// Averaging window for a ball of kLarge px radius or more; longer for smaller ones, as vibration
/// by a pixel is more degrees there.
constexpr Time kWindow = std::chrono::milliseconds(800);
constexpr double kLarge = 300, kLongest = 3;
/// Time over which the ball's place against the reference is averaged at the beginning.
constexpr Time kSettling = std::chrono::milliseconds(2400);
/// Pause before the next attempt after a reference had too little texture: making one costs as much
/// as watching for a second.
constexpr Time kPauseOfReferences = std::chrono::seconds(5);
/// Distance of a jump from the mean: warning limits, standard deviations of single frames, and
/// pixels.
constexpr double kJump = 4, kJumpSpreads = 6, kJumpPixels = 2;
/// Time for which a picture that is like the ones before is not measured, less than a tenth of a
/// second so that a camera's jitter does not lengthen it by a frame.
constexpr Time kPauseOfMeasurements = std::chrono::milliseconds(90);
/// Share of the warning limit up to which a picture is like the ones before.
constexpr double kUnchanged = 0.5;
/// Standard deviations of the mean by which a limit must be exceeded.
constexpr double kSure = 2;
/// Share of the radius up to which the error is in proportion.
constexpr double kSmallMotion = 0.01;
/// The surroundings' share of the ball's motion: weight of a new frame in its mean, least for a
/// turned camera, most for a moved ball.
constexpr double kNewShare = 0.2, kTurned = 0.7, kStayed = 0.3;

Result<> check(const DriftSubject& subject, const DriftLimits& limits) {
  const auto outline = optics::check_outline(subject.outline, subject.width, subject.height);
  if (!outline) return outline;
  if (std::min(subject.outline.rx, subject.outline.ry) < kSmallestTracked) {
    return fail("the ball's radius is below " + std::to_string(static_cast<int>(kSmallestTracked)) +
                " px: too few to see it move");
  }
  if (!(limits.warning > 0 && limits.alarm >= limits.warning && std::isfinite(limits.alarm))) {
    return fail("the limits must be above 0, the alarm's not below the warning's");
  }
  return {};
}

}  // namespace

Result<DriftSubject> drift_subject(const optics::Rig& rig, const optics::RigCamera& camera) {
  const auto projection = optics::ball_projection(rig, camera);
  if (!projection) return tl::unexpected(projection.error());
  const auto outline = camera.outline ? camera.outline : projection->outline();
  if (!outline) return fail("camera " + camera.name + ": its lens does not show the whole limb");
  DriftSubject subject{camera.width, camera.height, *outline, *projection, std::nullopt};
  if (camera.intrinsics) {
    const auto lens = optics::Lens::make(*camera.intrinsics);
    if (!lens) return tl::unexpected(lens.error());
    subject.lens = *lens;
  }
  return subject;
}

std::string_view text(DriftLevel level) {
  switch (level) {
    case DriftLevel::NotMeasured:
      return "not measured";
    case DriftLevel::Good:
      return "good";
    case DriftLevel::Warning:
      return "warning";
    case DriftLevel::Alarm:
      break;
  }
  return "alarm";
}

std::string_view text(DriftCause cause) {
  switch (cause) {
    case DriftCause::Unknown:
      return "unknown";
    case DriftCause::CameraTurned:
      return "the camera turned";
    case DriftCause::BallMoved:
      break;
  }
  return "the ball moved";
}

class DriftMonitor::Impl {
 public:
  Impl(const DriftSubject& subject, const DriftLimits& limits)
      : subject_(subject),
        limits_(limits),
        view_error_(subject.projection, subject.outline),
        window_(std::chrono::duration_cast<Time>(
            kWindow * std::clamp(kLarge / subject.outline.rx, 1.0, kLongest))),
        statistics_(view_error_, window_),
        reference_(BallTracker::scale_for(subject.outline)) {
    state_.outline = subject.outline;
  }

  Result<> refer_to(const Picture& picture, const std::optional<DriftZero>& zero) {
    if (auto checked = check_size(picture); !checked) return checked;
    state_.reason = exposure_fault(picture, subject_.outline);
    if (!state_.reason.empty()) return fail(std::string(state_.reason));
    reference_.add(picture);
    if (!take_reference(saturation(picture.format))) return fail(std::string(state_.reason));
    is_settling_ = false;
    if (!zero) return {};
    origin_ = zero->place;
    origin_sigma_ = zero->sigma;
    return {};
  }

  DriftZero zero() const { return {origin_, origin_sigma_.value_or(0)}; }

  Result<DriftState> observe(const Picture& picture, Time time) {
    if (auto checked = check_size(picture); !checked) return tl::unexpected(checked.error());
    if (!tracker_ && !collect(picture, time)) return not_measured(state_.reason);
    if (is_as_before(picture, time)) return state_;
    const auto motion = tracker_->find(picture);
    if (!motion) return not_measured(tracker_->reason());
    measured_at_ = time;
    add(*motion, time);
    state_.reason = {};
    state_.is_learning = is_settling_;
    state_.motion = statistics_.mean() - origin_;
    state_.outline = moved(subject_.outline, state_.motion);
    state_.direction_error = error_of(state_.motion);
    state_.direction_sigma = sigma();
    state_.level = level();
    explain(picture, *motion - origin_);
    return state_;
  }

 private:
  Result<> check_size(const Picture& picture) const {
    if (picture.width == subject_.width && picture.height == subject_.height) return {};
    return fail("the picture is " + std::to_string(picture.width) + "x" +
                std::to_string(picture.height) + ", the alignment is for " +
                std::to_string(subject_.width) + "x" + std::to_string(subject_.height));
  }

  /// Collects pictures for the reference; false while it cannot be used, with the reason.
  bool collect(const Picture& picture, Time time) {
    if (time < collects_from_) return false;
    state_.reason = exposure_fault(picture, subject_.outline);
    if (!state_.reason.empty()) return false;
    reference_.add(picture);
    state_.reason = fault::kNoReference;
    if (!reference_.is_complete()) return false;
    if (take_reference(saturation(picture.format))) return true;
    collects_from_ = time + kPauseOfReferences;
    return false;
  }

  bool take_reference(float saturated) {
    BallTracker tracker(reference_.median(), subject_.outline, saturated);
    reference_ = ReferencePicture(BallTracker::scale_for(subject_.outline));
    state_.reason = fault::kFlat;
    if (!tracker.has_texture()) return false;
    tracker_ = std::move(tracker);
    return true;
  }

  DriftState not_measured(std::string_view reason) {
    state_.level = DriftLevel::NotMeasured;
    state_.is_learning = reason == fault::kNoReference;
    state_.reason = reason;
    return state_;
  }

  /// True: the ball was measured a moment ago, rests within half the warning limit of its origin,
  /// and a glance shows it at its mean place. Everything else is measured in its own frame: jumps,
  /// darkness, the second half of a drift's way to its limit, vibration, the first seconds.
  bool is_as_before(const Picture& picture, Time time) {
    const Time since = time - measured_at_;
    const double alike = kUnchanged * limits_.warning;
    const bool may_wait = state_.level != DriftLevel::NotMeasured && !is_settling_ &&
                          since >= Time::zero() && since < kPauseOfMeasurements &&
                          statistics_.is_complete() && statistics_.spread() <= alike &&
                          state_.direction_error <= alike;
    if (!may_wait) return false;
    const auto distance = tracker_->distance_from(picture, statistics_.mean());
    return distance && view_error_.small({*distance, 0, 0, 0}) <= alike;
  }

  /// Distance of a jump from the mean, degrees.
  double jump() const {
    return std::max({kJump * limits_.warning, kJumpSpreads * statistics_.spread(),
                     view_error_.small({kJumpPixels, 0, 0, 0})});
  }

  /// The ball's mean place counts as its origin until it has settled or jumped. Few pictures per
  /// second need longer: an origin without a spread would count as exact.
  void add(const PictureMotion& motion, Time time) {
    if (!statistics_.empty() && error_of(motion - statistics_.mean()) > jump()) {
      statistics_.restart();
      is_settling_ = false;
    }
    if (!first_time_) first_time_ = time;
    if (time - *first_time_ > kSettling && statistics_.knows_spread()) is_settling_ = false;
    statistics_.add(time, motion);
    if (!is_settling_) return;
    ++settled_;
    origin_ = origin_ + scaled(motion - origin_, 1.0 / settled_);
    if (statistics_.knows_spread()) origin_sigma_ = statistics_.sigma_of(settled_);
  }

  /// Standard deviation of the motion; a single reference picture is as far from the mean as any.
  double sigma() const {
    return std::hypot(statistics_.sigma(), origin_sigma_.value_or(statistics_.spread()));
  }

  double error_of(const PictureMotion& motion) const {
    const double largest = kSmallMotion * subject_.outline.rx;
    const bool is_small = std::hypot(motion.u, motion.v) < largest &&
                          std::hypot(motion.growth, motion.roll) < kSmallMotion;
    return is_small ? view_error_.small(motion) : view_error_.exact(motion);
  }

  /// Raised when the error is above a limit with certainty, lowered when it is below. While the
  /// spread is unknown only a jump is certain: all else may be vibration.
  DriftLevel level() const {
    const bool is_certain = statistics_.knows_spread() || state_.direction_error > jump();
    const double sure = is_certain ? state_.direction_error - kSure * state_.direction_sigma : 0;
    const auto exceeds = [&](double limit, DriftLevel raised) {
      return sure > limit || (last_level_ >= raised && state_.direction_error > limit);
    };
    if (exceeds(limits_.alarm, DriftLevel::Alarm)) return DriftLevel::Alarm;
    return exceeds(limits_.warning, DriftLevel::Warning) ? DriftLevel::Warning : DriftLevel::Good;
  }

  /// Determines the cause, as far as the surroundings show it.
  void explain(const Picture& picture, const PictureMotion& now) {
    last_level_ = state_.level;
    state_.cause = DriftCause::Unknown;
    state_.turn.reset();
    if (state_.level == DriftLevel::Good) {
      share_.reset();
      return;
    }
    if (const auto share = tracker_->share_of_surroundings(picture, now)) {
      share_ = std::lerp(share_.value_or(*share), *share, kNewShare);
    }
    if (!share_) return;
    if (*share_ < kStayed) state_.cause = DriftCause::BallMoved;
    if (*share_ > kTurned) {
      state_.cause = DriftCause::CameraTurned;
      if (subject_.lens) turn_back(*subject_.lens);
    }
  }

  /// Computes the camera's rotation, and the limb in the turned camera's picture: a similarity does
  /// not include the lens's effect on a turn.
  void turn_back(const optics::Lens& lens) {
    state_.turn = camera_turn(lens, subject_.outline, state_.motion);
    const auto sight = optics::sight_from_outline(subject_.outline, lens);
    if (!state_.turn || !sight) return;
    const auto limb =
        optics::outline_from_sight({*state_.turn * sight->axis, sight->distance}, lens);
    if (limb) state_.outline = *limb;
  }

  DriftSubject subject_;
  DriftLimits limits_;
  ViewError view_error_;
  Time window_;
  MotionStatistics statistics_;
  ReferencePicture reference_;
  Time collects_from_ = Time::min();
  std::optional<BallTracker> tracker_;
  std::optional<Time> first_time_;
  Time measured_at_{};
  bool is_settling_ = true;
  int settled_ = 0;       ///< frames
  PictureMotion origin_;  ///< against the reference picture
  /// Standard deviation of the origin, degrees; none if a single picture is the reference, or a
  /// jump ended the learning before the spread was known.
  std::optional<double> origin_sigma_;
  DriftLevel last_level_ = DriftLevel::Good;  ///< the latest one measured
  std::optional<double> share_;
  DriftState state_;
};

DriftMonitor::DriftMonitor(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DriftMonitor::DriftMonitor(DriftMonitor&&) noexcept = default;
DriftMonitor& DriftMonitor::operator=(DriftMonitor&&) noexcept = default;
DriftMonitor::~DriftMonitor() = default;

Result<DriftMonitor> DriftMonitor::make(const DriftSubject& subject, const DriftLimits& limits) {
  if (auto checked = check(subject, limits); !checked) return tl::unexpected(checked.error());
  return DriftMonitor(std::make_unique<Impl>(subject, limits));
}

Result<> DriftMonitor::refer_to(const Picture& picture, const std::optional<DriftZero>& zero) {
  return impl_->refer_to(picture, zero);
}

DriftZero DriftMonitor::zero() const { return impl_->zero(); }

Result<DriftState> DriftMonitor::observe(const Picture& picture, Time time) {
  return impl_->observe(picture, time);
}

}  // namespace orbwatch::align
