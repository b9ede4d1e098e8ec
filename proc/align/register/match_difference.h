#pragma once

#include <array>
#include <optional>
#include <vector>

#include "proc/align/register/feature_matches.h"
#include "proc/align/register/line_of_sight.h"
#include "proc/align/register/refinement_trial.h"

namespace orbwatch::align {

/// What the reference camera sees at a match, and how exactly both know.
struct SightedMatch {
  optics::Vec3 direction;  ///< through the stated scene
  LineOfSight line;        ///< for where none is stated
  optics::Vec2 pixel;      ///< in the sought camera's picture
  double sigma;            ///< radians
};

/// Those of the matches that both balls show. Reentrant.
std::vector<SightedMatch> sighted(const std::vector<Match>& matches,
                                  const optics::BallProjection& reference,
                                  const optics::BallProjection& camera);

/// By how many sigmas both cameras differ: their directions by x, y, z and, where no scene is
/// stated, what they see from the mean of the room.
using Difference = std::array<double, 4>;

double length(const Difference& difference);

/// That of the directions alone, in sigmas.
double direction_error(const Difference& difference);

/// At a trial that has a projection. Reentrant.
Difference difference(const SightedMatch& match, const TrialPlace& trial);

/// The lengths of all differences. Reentrant.
std::vector<double> errors(const std::vector<SightedMatch>& matches, const TrialPlace& trial);

double median(std::vector<double> values);

/// The median of the errors, in what a unit normal distribution in two dimensions has.
double robust_sigma(const std::vector<double>& errors);

/// What matches tell about a room, all else at a trial being right.
struct RoomEvidence {
  RoomCloseness room;
  /// Of the matches' sigmas: what differs across the parallax, which no room explains.
  double noise = 1;
};

/// One round of expectation and maximisation: the closeness of each match given the trial's room,
/// then the spread of all. What does not fit counts little. Reentrant.
RoomEvidence room_evidence(const std::vector<SightedMatch>& matches, const TrialPlace& trial);

}  // namespace orbwatch::align
