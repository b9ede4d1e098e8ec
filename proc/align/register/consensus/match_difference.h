// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "proc/align/register/consensus/refinement_trial.h"
#include "proc/align/register/features/feature_matches.h"
#include "proc/align/register/light/line_of_sight.h"

namespace orbwatch::align {

/// The reference camera's sight of a match, and the accuracy of both.
struct SightedMatch {
  optics::Vec3 direction;  ///< through the stated scene
  LineOfSight line;        ///< used where no scene is stated
  optics::Vec2 pixel;      ///< in the sought camera's picture
  double sigma;            ///< radians
};

/// Matches that both balls show. Reentrant.
std::vector<SightedMatch> sighted(const std::vector<Match>& matches,
                                  const optics::BallProjection& reference,
                                  const optics::BallProjection& camera);

/// Difference between both cameras, in sigmas: their directions by x, y, z and, where no scene is
/// stated, the closeness against the room's mean.
using Difference = std::array<double, 4>;

double length(const Difference& difference);

/// Length of the directions' difference alone, in sigmas.
double direction_error(const Difference& difference);

/// The difference at a trial that has a projection. Reentrant.
Difference difference(const SightedMatch& match, const TrialPlace& trial);

/// The lengths of all differences. Reentrant.
std::vector<double> errors(const std::vector<SightedMatch>& matches, const TrialPlace& trial);

double median(std::vector<double> values);

/// Sigma from the median of the errors of a normal distribution in two dimensions.
double robust_sigma(const std::vector<double>& errors);

/// Estimate of a room from matches, assuming that everything else at a trial is right.
struct RoomEvidence {
  RoomCloseness room;
  /// Factor of the matches' sigmas: the difference across the parallax, which no room explains.
  double noise = 1;
};

/// One round of expectation and maximisation: the closeness of each match given the trial's room,
/// then the spread of all. Matches that do not fit have little weight. Reentrant.
RoomEvidence room_evidence(const std::vector<SightedMatch>& matches, const TrialPlace& trial);

}  // namespace orbwatch::align
