// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/consensus/match_difference.h"

#include <algorithm>
#include <cmath>

#include "proc/optics/resolution.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Vec3;

// Standard deviation of a feature's coordinates in either picture.
constexpr double kPixelSigma = 0.5;
constexpr double kLeastSpread = 1e-4;  // closeness: spread of a room that is practically far away
// Radians per closeness, below which a match has no information.
constexpr double kLeastParallax = 0.1;
constexpr double kDoubtfulFrom = 2;  // sigmas

std::optional<Meeting> meeting(const SightedMatch& match, const TrialPlace& trial) {
  const auto line = line_of_sight(*trial.ball, match.pixel);
  if (!line) return std::nullopt;
  return meeting(*line, match.line, match.sigma, *trial.room);
}

Difference difference(const Vec3& apart, double sigma, double deviation) {
  return {apart.x / sigma, apart.y / sigma, apart.z / sigma, deviation};
}

double deviation(const Meeting& met, const RoomCloseness& room) {
  return (met.closeness - room.mean) / room.spread;
}

}  // namespace

std::vector<SightedMatch> sighted(const std::vector<Match>& matches,
                                  const BallProjection& reference, const BallProjection& camera) {
  std::vector<SightedMatch> all;
  for (const Match& match : matches) {
    const auto direction = reference.direction(match.reference);
    const auto line = line_of_sight(reference, match.reference);
    if (!direction || !line) continue;
    const double a = optics::resolution(reference, *direction);
    const double b = optics::resolution(camera, *direction);
    if (!(a > 0 && b > 0)) continue;
    all.push_back(
        {*direction, *line, match.camera, optics::radians(kPixelSigma * std::hypot(1 / a, 1 / b))});
  }
  return all;
}

double length(const Difference& d) {
  return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + d[3] * d[3]);
}

double direction_error(const Difference& d) { return std::hypot(d[0], d[1], d[2]); }

Difference difference(const SightedMatch& match, const TrialPlace& trial) {
  if (trial.room) {
    const auto met = meeting(match, trial);
    if (met) return difference(met->apart, match.sigma, deviation(*met, *trial.room));
  } else if (const auto direction = trial.ball->direction(match.pixel)) {
    return difference(*direction - match.direction, match.sigma, 0);
  }
  // A sight outside of the trial's limb gets the largest error.
  return difference(match.direction, match.sigma, 0);
}

std::vector<double> errors(const std::vector<SightedMatch>& matches, const TrialPlace& trial) {
  std::vector<double> lengths;
  lengths.reserve(matches.size());
  for (const SightedMatch& match : matches) lengths.push_back(length(difference(match, trial)));
  return lengths;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double robust_sigma(const std::vector<double>& errors) { return median(errors) / 1.1774; }

RoomEvidence room_evidence(const std::vector<SightedMatch>& matches, const TrialPlace& trial) {
  const RoomCloseness& room = *trial.room;
  std::vector<double> across;
  double squares = 0, weights = 0;
  for (const SightedMatch& match : matches) {
    const auto met = meeting(match, trial);
    if (!met) continue;
    const double steepness = dot(met->slope, met->slope);
    if (steepness < kLeastParallax * kLeastParallax) continue;
    const Vec3 other = met->apart - met->slope * (dot(met->apart, met->slope) / steepness);
    across.push_back(norm(other) / match.sigma);
    const double deviates = deviation(*met, room);
    const double error = length(difference(met->apart, match.sigma, deviates)) / kDoubtfulFrom;
    const double weight = 1 / (1 + error * error);
    const double unsure =
        1 / (steepness / (match.sigma * match.sigma) + 1 / (room.spread * room.spread));
    squares += weight * (deviates * deviates * room.spread * room.spread + unsure);
    weights += weight;
  }
  if (across.empty()) return {room, 1};
  return {{room.mean, std::max(kLeastSpread, std::sqrt(squares / weights))},
          std::max(0.1, median(across) / 0.6745)};
}

}  // namespace orbwatch::align
