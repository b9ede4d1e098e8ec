// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/light/light_registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "proc/align/matrix3.h"
#include "proc/align/register/light/bright_spots.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Mat3;
using optics::radians;
using optics::Vec2;
using optics::Vec3;

constexpr std::size_t kDistances = 8;  // possible distances of a spark along its ray
constexpr double kNearest = 2;         // ball radii from the ball's centre
constexpr double kFarthest = 1000;
constexpr int kTrials = 4000;
constexpr std::array kTolerances{0.05, 0.05, 0.03, 0.02};  // shares of the ball's radius
constexpr int kStepsPerTolerance = 150;
constexpr int kLeastInliers = 12;
constexpr std::size_t kMostRotations = 4;
constexpr double kRivalry = 0.6;  // share of the best score; a rival's edges are compared, too
const double kDifferent = radians(20);
const double kSamePlace = radians(6);

/// Directions that the light of a spot may come from, nearest first.
struct Source {
  std::array<Vec3, kDistances> directions;
  std::array<double, kDistances> closeness;
  double weight = 1;
};

/// The light at one moment.
struct Moment {
  std::vector<Source> sources;  ///< seen by the reference camera
  std::vector<Vec2> spots;      ///< in the sought camera's picture
};

std::optional<Source> source(const BallProjection& ball, const Vec2& pixel) {
  const auto ray = ball.ray(pixel);
  const auto end = ball.direction(pixel);
  if (!ray || !end) return std::nullopt;
  const double radius = ball.ball().radius;
  const Vec3 origin = (ray->origin - ball.ball().centre) * (1 / radius);
  const double far =
      1 / std::max(ball.proxy().is_far() ? 0 : ball.proxy().hit(*end).closeness, 1 / kFarthest);
  Source source{};
  for (std::size_t n = 0; n < kDistances; ++n) {
    // Distances are spaced evenly in closeness, which determines the shift of a spot.
    const double share = static_cast<double>(n) / (kDistances - 1);
    const double distance = 1 / std::lerp(1 / kNearest, 1 / std::max(far, kNearest), share);
    const Vec3 point = origin + ray->direction * std::max(0.0, distance - 1);
    source.directions[n] = normalized(point);
    source.closeness[n] = 1 / norm(point);
  }
  return source;
}

/// A trial rotation's agreement with all light.
struct Agreement {
  double score = 0;
  int inliers = 0;
  double squares = 0;  ///< sum of squares of the inliers' errors, shares of the radius
  std::vector<Vec3> directions;
};

/// Lets light that stays in one place, such as a melt pool, count once however many moments show
/// it: every turn about it would explain all of its sightings.
void weigh(std::vector<Moment>& moments) {
  const auto is_near = [](const Source& a, const Source& b) {
    return dot(a.directions.back(), b.directions.back()) > std::cos(kSamePlace);
  };
  const auto shows = [&](const Moment& moment, const Source& source) {
    return std::ranges::any_of(moment.sources,
                               [&](const Source& other) { return is_near(other, source); });
  };
  for (Moment& moment : moments) {
    for (Source& source : moment.sources) {
      source.weight =
          1.0 / static_cast<double>(std::ranges::count_if(
                    moments, [&](const Moment& other) { return shows(other, source); }));
    }
  }
}

/// A trial rotation and its score.
struct Candidate {
  Mat3 rotation;
  double score = 0;
};

class LightSearch {
 public:
  LightSearch(std::vector<Moment> moments, const SoughtCamera& sought)
      : moments_(std::move(moments)), sought_(sought) {
    weigh(moments_);
    for (std::size_t m = 0; m < moments_.size(); ++m) {
      if (!moments_[m].sources.empty() && !moments_[m].spots.empty()) lit_.push_back(m);
    }
    radius_ = optics::mean_radius(*sought.camera.outline);
  }

  Result<std::vector<Registration>> run() {
    if (lit_.size() < kLeastPictures) {
      return fail("only " + std::to_string(lit_.size()) + " moments show light to both cameras, " +
                  std::to_string(kLeastPictures) +
                  " are needed: record a longer sequence of the running process");
    }
    for (int trial = 0; trial < kTrials; ++trial) {
      const auto rotation = hypothesis();
      if (rotation) note({*rotation, agreement(*rotation, kTolerances.front()).score});
    }
    std::vector<Registration> found;
    int most = 0;
    for (const Candidate& candidate : candidates_) {
      if (candidate.score < kRivalry * candidates_.front().score) break;
      const Registration one = registration(polished(candidate.rotation));
      most = std::max(most, one.inliers);
      if (one.inliers >= kLeastInliers) found.push_back(one);
    }
    if (found.empty()) {
      return fail("only " + std::to_string(most) + " spots of light agree, " +
                  std::to_string(kLeastInliers) +
                  " are needed: record a longer sequence of the running process");
    }
    return found;
  }

 private:
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }

  /// A rotation from two spots of each camera, in one moment or in two.
  std::optional<Mat3> hypothesis() {
    std::array<const Source*, 2> sources{};
    std::array<Vec2, 2> spots;
    for (std::size_t n = 0; n < 2; ++n) {
      const Moment& moment = moments_[lit_[below(lit_.size())]];
      sources[n] = &moment.sources[below(moment.sources.size())];
      spots[n] = moment.spots[below(moment.spots.size())];
    }
    Mat3 rotation;
    for (int round = 0; round < 3; ++round) {
      const auto ball =
          round == 0 ? in_own_frame(sought_) : turned(sought_, rotation, *sought_.camera.outline);
      if (!ball) return std::nullopt;
      std::array<DirectionPair, 2> pairs;
      for (std::size_t n = 0; n < 2; ++n) {
        const auto ray = ball->ray(spots[n]);
        if (!ray) return std::nullopt;
        const Vec3 direction = round == 0 ? ray->direction : *ball->direction(spots[n]);
        pairs[n] = {sources[n]->directions[kDistances - 2], transposed(rotation) * direction};
      }
      const double apart = angle_between(pairs[0].reference, pairs[1].reference);
      const double differs = apart - angle_between(pairs[0].camera, pairs[1].camera);
      if (apart < radians(8) || (round > 0 && std::abs(differs) > radians(8))) return std::nullopt;
      rotation = fit_rotation(pairs);
    }
    return rotation;
  }

  Agreement agreement(const Mat3& rotation, double tolerance) const {
    Agreement sum;
    const auto ball = turned(sought_, rotation, *sought_.camera.outline);
    if (!ball) return sum;
    for (const std::size_t m : lit_) {
      for (const auto& [source, error] : mutual(*ball, moments_[m])) {
        sum.score += source->weight * std::exp(-error * error / (tolerance * tolerance));
        if (error > 2 * tolerance) continue;
        ++sum.inliers;
        sum.squares += error * error;
        sum.directions.push_back(source->directions.back());
      }
    }
    return sum;
  }

  /// Sources and spots that are each other's nearest, with their distance as a share of the radius.
  std::vector<std::pair<const Source*, double>> mutual(const BallProjection& ball,
                                                       const Moment& moment) const {
    const std::size_t rows = moment.sources.size(), columns = moment.spots.size();
    std::vector<double> apart(rows * columns, HUGE_VAL);
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t n = 0; n < kDistances; ++n) {
        const Source& source = moment.sources[i];
        const auto pixel = ball.pixel(source.directions[n], source.closeness[n]);
        if (!pixel) continue;
        for (std::size_t j = 0; j < columns; ++j) {
          const Vec2& spot = moment.spots[j];
          double& least = apart[i * columns + j];
          least = std::min(least, std::hypot(pixel->u - spot.u, pixel->v - spot.v) / radius_);
        }
      }
    }
    std::vector<std::pair<const Source*, double>> pairs;
    for (std::size_t i = 0; i < rows; ++i) {
      const auto row = apart.begin() + static_cast<std::ptrdiff_t>(i * columns);
      const auto nearest = std::min_element(row, row + static_cast<std::ptrdiff_t>(columns));
      const auto j = static_cast<std::size_t>(nearest - row);
      bool is_mutual = true;
      for (std::size_t k = 0; k < rows; ++k) {
        is_mutual = is_mutual && (k == i || apart[k * columns + j] >= *nearest);
      }
      if (is_mutual) pairs.emplace_back(&moment.sources[i], *nearest);
    }
    return pairs;
  }

  /// Keeps the best candidates, the best first, of which no two are nearly the same.
  void note(const Candidate& trial) {
    const auto is_near = [&](const Candidate& other) {
      return angle_between(trial.rotation, other.rotation) < kDifferent;
    };
    const bool is_known = std::ranges::any_of(candidates_, [&](const Candidate& other) {
      return is_near(other) && other.score >= trial.score;
    });
    if (is_known) return;
    std::erase_if(candidates_, is_near);
    const auto at =
        std::ranges::lower_bound(candidates_, trial.score, std::greater{}, &Candidate::score);
    candidates_.insert(at, trial);
    if (candidates_.size() > kMostRotations) candidates_.pop_back();
  }

  /// The rotation improved by random turns, smaller and smaller.
  Mat3 polished(Mat3 rotation) {
    std::normal_distribution<double> any;
    for (const double tolerance : kTolerances) {
      double score = agreement(rotation, tolerance).score;
      for (int step = 0; step < kStepsPerTolerance; ++step) {
        const Vec3 turn = Vec3{any(random_), any(random_), any(random_)} * tolerance;
        const Mat3 trial = rotation_about(turn) * rotation;
        const double better = agreement(trial, tolerance).score;
        if (better <= score) continue;
        score = better;
        rotation = trial;
      }
    }
    return rotation;
  }

  Registration registration(const Mat3& rotation) const {
    const Agreement found = agreement(rotation, kTolerances.back());
    Registration r;
    r.rotation = rotation;
    r.outline = *sought_.camera.outline;
    r.inliers = found.inliers;
    // A ball in the middle of its picture turns directions by two degrees per degree on it.
    const double sigma = 2 * std::sqrt(found.squares / std::max(found.inliers, 1));
    r.residual = optics::degrees(sigma);
    Mat3 information{{}, {}, {}};
    for (const Vec3& d : found.directions) information = information + Mat3{} + outer(d, d) * -1;
    r.covariance = inverse(information) * (sigma * sigma);
    return r;
  }

  std::vector<Moment> moments_;
  const SoughtCamera& sought_;
  std::vector<std::size_t> lit_;  ///< moments in which both see light
  double radius_ = 0;
  std::mt19937_64 random_{1};
  std::vector<Candidate> candidates_;
};

}  // namespace

Result<std::vector<Registration>> register_by_light(const SimultaneousPictures& pictures,
                                                    const BallProjection& reference,
                                                    const SoughtCamera& sought) {
  const auto seen = bright_spots(pictures.reference, reference.outline());
  if (!seen) return tl::unexpected(seen.error());
  const auto others = bright_spots(pictures.camera, sought.camera.outline);
  if (!others) return tl::unexpected(others.error());
  const auto unturned = in_own_frame(sought);
  if (!unturned) return tl::unexpected(unturned.error());
  std::vector<Moment> moments(std::min(seen->size(), others->size()));
  for (std::size_t m = 0; m < moments.size(); ++m) {
    for (const BrightSpot& spot : (*seen)[m]) {
      if (const auto at = source(reference, spot.centre)) moments[m].sources.push_back(*at);
    }
    for (const BrightSpot& spot : (*others)[m]) {
      if (unturned->ray(spot.centre)) moments[m].spots.push_back(spot.centre);
    }
  }
  auto found = LightSearch(std::move(moments), sought).run();
  if (!found) return found;
  const Picture &a = pictures.reference.front(), &b = pictures.camera.front();
  for (Registration& one : *found) {
    const auto ball = turned(sought, one.rotation, one.outline);
    if (!ball) return tl::unexpected(ball.error());
    one.overlap = overlap(reference, a.width, a.height, *ball, b.width, b.height);
  }
  return found;
}

}  // namespace orbwatch::align
