// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string_view>

#include "proc/align/drift/picture_motion.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::align {

/// The stored alignment of one watched camera.
struct DriftSubject {
  int width = 0;  ///< px, size of the camera's pictures
  int height = 0;
  optics::Outline outline;  ///< the ball's limb, px
  optics::BallProjection projection;
  /// Lens, if known; it makes a turn of the camera computable.
  std::optional<optics::Lens> lens;
};

/// The subject from a rig and one of its cameras. Error: that of optics::ball_projection; a ball
/// whose limb the lens does not show as a whole.
Result<DriftSubject> drift_subject(const optics::Rig& rig, const optics::RigCamera& camera);

/// Limits of the error of view directions, degrees rms.
struct DriftLimits {
  double warning = 0.3;
  double alarm = 0.6;
};

/// State of the alignment.
enum class DriftLevel { NotMeasured, Good, Warning, Alarm };
inline constexpr int kDriftLevels = 4;

std::string_view text(DriftLevel level);

/// The most likely cause of a drift.
enum class DriftCause { Unknown, CameraTurned, BallMoved };

std::string_view text(DriftCause cause);

/// Measured drift of the alignment.
struct DriftState {
  DriftLevel level = DriftLevel::NotMeasured;
  /// The zero is being learnt: a slow motion now moves it, too, and `motion` says little.
  bool is_learning = false;
  std::string_view reason;  ///< reason for an operator while it is not measured; static text
  /// Motion of the ball's picture, mean over the last frames; the last measured one while not
  /// measured.
  PictureMotion motion;
  double direction_error = 0;  ///< degrees rms, see ViewError
  double direction_sigma = 0;  ///< standard deviation of direction_error, degrees; too small in the
                               ///< first frames after refer_to(), whose spread is not known yet
  DriftCause cause = DriftCause::Unknown;
  optics::Outline outline;           ///< corrected, px
  std::optional<optics::Mat3> turn;  ///< rotation of a turned camera with a known lens: R_corrected
                                     ///< = turn R_stored (R: world to camera)
};

/// The zero that drift is measured from, relative to a reference picture.
struct DriftZero {
  PictureMotion place;  ///< the ball's motion at the zero against that picture
  double sigma = 0;     ///< standard deviation of the place, degrees rms of view direction
};

/// Watches whether a camera or the ball has moved against the stored alignment.
///
/// The reference is the content of the first five usable pictures and the ball's mean place in the
/// first 2.4 s, eight pictures at least, or the picture on which the alignment was made. A picture
/// within 90 ms of the one measured last is only glanced at, and the state stays, while the ball
/// rests: its last motions and a fifth of its patches are within half the warning limit of their
/// mean, and the error of directions is below half of it. observe() costs some tenths of a
/// millisecond whatever the picture's size, a glance a fifth of that; tens of milliseconds for the
/// first pictures, a few for one in which the ball has jumped, and for one in 30 while the ball is
/// not where it was or not visible. Not reentrant: one thread at a time.
class DriftMonitor {
 public:
  using Time = std::chrono::nanoseconds;

  /// Errors: an outline outside of the picture or smaller than 24 px, limits that are not above 0
  /// or the alarm's below the warning's.
  static Result<DriftMonitor> make(const DriftSubject& subject, const DriftLimits& limits);

  DriftMonitor(DriftMonitor&&) noexcept;
  DriftMonitor& operator=(DriftMonitor&&) noexcept;
  ~DriftMonitor();

  /// Sets the picture on which the alignment was made as reference; before the first observe().
  /// `zero`: relative to it; none: the ball's place in it. Errors: another size, the reason why it
  /// cannot be used.
  Result<> refer_to(const Picture& picture, const std::optional<DriftZero>& zero = std::nullopt);

  /// The zero as far as it is learnt, relative to the reference.
  DriftZero zero() const;

  /// Evaluates a frame; `time` of any clock that does not jump. Error: another size.
  Result<DriftState> observe(const Picture& picture, Time time);

 private:
  class Impl;
  explicit DriftMonitor(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace orbwatch::align
