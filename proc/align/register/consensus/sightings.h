// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "proc/align/register/features/feature_matches.h"
#include "proc/align/register/light/line_of_sight.h"
#include "proc/align/register/registration.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::align {

/// Largest angle at which a match agrees with a trial rotation, radians.
inline const double kAgreement = optics::radians(1.5);
/// Angle from which on rotations, and directions, are altogether different, radians.
inline const double kDifferent = optics::radians(8);

/// Matches as directions, which depend on the turned camera's place and on the room. Not for two
/// threads at once.
class Sightings {
 public:
  Sightings() = default;
  Sightings(const Sightings&) = delete;
  Sightings& operator=(const Sightings&) = delete;
  virtual ~Sightings() = default;

  virtual std::size_t size() const = 0;
  virtual const Match& match(std::size_t n) const = 0;
  /// Most rotations worth a trial.
  virtual int most_trials() const = 0;
  /// A rotation from two matches; nullopt when they contradict each other, or when a camera that is
  /// turned like that has no projection.
  virtual std::optional<optics::Mat3> hypothesis(const std::array<std::size_t, 2>& chosen) = 0;
  /// Directions of each match in both cameras with the sought one turned: in the reference frame,
  /// and in the sought camera's own. All nullopt when the turned camera has no projection.
  virtual std::vector<std::optional<DirectionPair>> pairs(const optics::Mat3& rotation) const = 0;
  /// A rotation improved by the matches that agree with it.
  virtual optics::Mat3 fitted(const optics::Mat3& rotation,
                              const std::vector<std::size_t>& inliers) const = 0;
  /// Largest angle at which a match agrees with a well fitted rotation, radians.
  virtual double exactness() const = 0;
  /// The room estimated from the agreeing matches; nullopt where a scene is stated.
  virtual std::optional<RoomCloseness> room(const optics::Mat3& rotation,
                                            const std::vector<std::size_t>& inliers) const = 0;
};

/// Sightings through the scene of the sought camera's rig; if it states none, anything may be
/// anywhere along both lines of sight. `sought` outlives them. Reentrant. Error: those of
/// in_own_frame().
Result<std::unique_ptr<Sightings>> make_sightings(const std::vector<Match>& matches,
                                                  const optics::BallProjection& reference,
                                                  const SoughtCamera& sought);

}  // namespace orbwatch::align
