// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/gradients/gradient_registration.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "proc/align/detect/picture/luminance.h"
#include "proc/align/matrix3.h"
#include "proc/align/register/gradients/gradient_field.h"
#include "proc/align/register/gradients/gradient_similarity.h"
#include "proc/align/register/gradients/place_fit.h"
#include "proc/align/register/sphere_view.h"
#include "proc/align/register/spiral.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Mat3;
using optics::radians;
using optics::Vec3;

constexpr int kDirections = 40000;  // sampled; those with edges are used
constexpr int kCoarseDirections = 8000;
constexpr double kCoarse = 2.5;  // sigma of smoothing, degrees
constexpr std::array kFiner{2.5, 1.5, 1.0,
                            0.8};  // sigma of each round, which starts from the last one's result
// The same of each round that fits the outline, too.
constexpr std::array kWithOutline{0.8, 0.5};
constexpr double kGridStep = 2;  // degrees
constexpr std::size_t kCandidates = 4;
constexpr double kApart = 3;               // degrees between candidates
constexpr double kSame = 1.5;              // degrees below which two summits are one
constexpr double kDistinct = 6.5;          // standard deviations; wrong rotations reach 5
constexpr double kRivalSimilarity = 0.85;  // share of the best similarity above chance
constexpr double kFinestView = 2;          // pixels per degree
constexpr int kLeastEdges = 100;

/// The pictures and the reference camera's views, which do not change.
class Scenery {
 public:
  static Result<Scenery> make(const ReferenceCamera& reference, const SoughtCamera& sought) {
    const auto ball = turned(sought, sought.camera.registration, *sought.camera.outline);
    if (!ball) return tl::unexpected(ball.error());
    const double resolution =
        std::min({kFinestView, best_resolution(reference.ball), 1.5 * best_resolution(*ball)});
    const cv::Mat seen = stretched(luminance_of(reference.picture));
    return sphere_faces(seen, reference.ball, resolution).map([&](const auto& faces) {
      return Scenery(sought, resolution, faces);
    });
  }

  /// The sought camera's outline as given.
  const optics::Outline& outline() const { return *sought_.camera.outline; }

  /// The reference camera's edges. `smoothing`: sigma, degrees.
  GradientField reference(double smoothing) const { return {reference_, smoothing * resolution_}; }
  /// The sought camera's edges under the assumption of a place.
  Result<GradientField> camera(const Place& place, double smoothing) const {
    return turned(sought_, place.rotation, place.outline)
        .and_then(
            [&](const BallProjection& ball) { return sphere_faces(picture_, ball, resolution_); })
        .map([&](const auto& faces) { return GradientField(faces, smoothing * resolution_); });
  }

 private:
  Scenery(const SoughtCamera& sought, double resolution, std::vector<SphereFace> reference)
      : sought_(sought),
        picture_(stretched(luminance_of(sought.picture))),
        resolution_(resolution),
        reference_(std::move(reference)) {}

  const SoughtCamera& sought_;
  cv::Mat picture_;
  double resolution_;
  std::vector<SphereFace> reference_;
};

/// Summits reached from the candidates, each once.
std::vector<Summit> climbed(const GradientSimilarity& similarity,
                            const std::vector<Summit>& candidates) {
  std::vector<Summit> summits;
  for (const Summit& candidate : candidates) {
    const Summit summit = climb(similarity, candidate.turn, radians(kGridStep), radians(1));
    const bool is_new = std::ranges::none_of(summits, [&](const Summit& other) {
      return norm(other.turn - summit.turn) < radians(kSame);
    });
    if (is_new) summits.push_back(summit);
  }
  return summits;
}

/// Summits of the similarity over all turns within reach.
std::vector<Summit> coarse_search(const GradientSimilarity& similarity) {
  std::vector<Summit> grid, candidates;
  const int steps = static_cast<int>(kGradientReach / kGridStep);
  for (int x = -steps; x <= steps; ++x) {
    for (int y = -steps; y <= steps; ++y) {
      for (int z = -steps; z <= steps; ++z) {
        const Vec3 turn = Vec3{1.0 * x, 1.0 * y, 1.0 * z} * radians(kGridStep);
        if (norm(turn) > radians(kGradientReach)) continue;
        grid.push_back({turn, similarity.at(turn), {}});
      }
    }
  }
  std::ranges::sort(grid, std::greater{}, &Summit::value);
  for (const Summit& candidate : grid) {
    if (candidates.size() == kCandidates) break;
    const bool is_new = std::ranges::none_of(candidates, [&](const Summit& other) {
      return norm(other.turn - candidate.turn) < radians(kApart);
    });
    if (is_new) candidates.push_back(candidate);
  }
  return climbed(similarity, candidates);
}

/// Distance of a summit's similarity from that of meaningless turns, in their standard deviations.
double distinction(const GradientSimilarity& similarity, double value) {
  constexpr int kTurns = 60;
  double sum = 0, squares = 0;
  for (int n = 0; n < kTurns; ++n) {
    const double other = similarity.at(spiral(n, kTurns) * radians(40 + 2 * n));
    sum += other;
    squares += other * other;
  }
  const double mean = sum / kTurns;
  return (value - mean) / std::sqrt(std::max(squares / kTurns - mean * mean, 1e-12));
}

/// Result from one candidate, with the outline as given.
struct Outcome {
  Mat3 rotation;
  double similarity = 0;
  double distinction = 0;
};

/// `on_round` is called before each round; its error ends the search.
Result<Outcome> follow(const Scenery& scenery, const Mat3& start,
                       const std::function<Result<>()>& on_round) {
  Outcome outcome;
  outcome.rotation = start;
  for (const double smoothing : kFiner) {
    if (auto wanted = on_round(); !wanted) return tl::unexpected(wanted.error());
    const auto field = scenery.camera({outcome.rotation, scenery.outline()}, smoothing);
    if (!field) return tl::unexpected(field.error());
    const GradientSimilarity similarity(scenery.reference(smoothing).samples(kDirections), *field);
    const double least = radians(0.4 * smoothing);
    const Summit summit = climb(similarity, {}, 2 * least, least);
    if (!is_positive_definite(summit.curvature * -1)) {
      return fail("the edges agree along a ridge and do not determine the rotation");
    }
    outcome.rotation = rotation_about(summit.turn) * outcome.rotation;
    outcome.similarity = summit.value;
    outcome.distinction = distinction(similarity, summit.value);
  }
  return outcome;
}

/// The refusal of a start from which the edges do not lead to one rotation.
auto refuse_start(const std::string& reason) {
  return fail(reason +
              ": start nearer, by marking points or from process light, or state the room's "
              "geometry");
}

/// The best of all candidates, if no other is close to it.
Result<Outcome> best_of(const Scenery& scenery, const Mat3& start, const WorkProgress& progress) {
  const auto field = scenery.camera({start, scenery.outline()}, kCoarse);
  if (!field) return tl::unexpected(field.error());
  const std::vector<Summit> summits =
      coarse_search({scenery.reference(kCoarse).samples(kCoarseDirections), *field});
  const auto rounds = static_cast<double>(summits.size() * kFiner.size());
  int round = 0;
  Result<> wanted;
  const auto on_round = [&] { return wanted = progress.at(WorkStep::Edges, round++ / rounds); };
  std::vector<Outcome> outcomes;
  for (const Summit& summit : summits) {
    const auto outcome = follow(scenery, rotation_about(summit.turn) * start, on_round);
    if (!wanted) return tl::unexpected(wanted.error());
    if (outcome) outcomes.push_back(*outcome);
  }
  if (outcomes.empty()) return refuse_start("the cameras' edges agree nowhere near the start");
  std::ranges::sort(outcomes, std::greater{}, &Outcome::similarity);
  const Outcome& best = outcomes.front();
  if (best.distinction < kDistinct) {
    return refuse_start("the cameras' edges agree no better than by accident");
  }
  for (const Outcome& other : outcomes) {
    if (angle_between(other.rotation, best.rotation) < radians(kSame)) continue;
    if (other.similarity > kRivalSimilarity * best.similarity) {
      return refuse_start("two different rotations fit nearly as well");
    }
  }
  return best;
}

/// Result of the last round of a fit with the outline.
struct Refined {
  PlaceFit fit;
  int inliers = 0;
};

Result<Refined> refined(const Scenery& scenery, const SoughtCamera& sought, const Mat3& rotation) {
  Refined best{{{rotation, scenery.outline()}, {}}, 0};
  for (const double smoothing : kWithOutline) {
    const auto field = scenery.camera(best.fit.place, smoothing);
    if (!field) return tl::unexpected(field.error());
    const auto samples = scenery.reference(smoothing).samples(kDirections);
    const auto fit = fit_place(samples, *field, sought, best.fit.place, smoothing);
    if (!fit) return tl::unexpected(fit.error());
    best = {*fit, GradientSimilarity(samples, *field).agreeing({})};
  }
  return best;
}

/// Covariance of the turn alone.
Mat3 turn_covariance(const PlaceCovariance& c) {
  return {{c(0, 0), c(0, 1), c(0, 2)}, {c(1, 0), c(1, 1), c(1, 2)}, {c(2, 0), c(2, 1), c(2, 2)}};
}

/// Degrees rms between both cameras' sights of the same edge, on average over a part of the sphere.
double residual(const Mat3& covariance) {
  const double trace = covariance.row0.x + covariance.row1.y + covariance.row2.z;
  return optics::degrees(std::sqrt(trace / 3 * GradientField::kParts));
}

}  // namespace

Result<Registration> register_by_gradients(const ReferenceCamera& reference,
                                           const SoughtCamera& sought,
                                           const WorkProgress& progress) {
  if (auto wanted = progress.at(WorkStep::Edges); !wanted) return tl::unexpected(wanted.error());
  const auto scenery = Scenery::make(reference, sought);
  if (!scenery) return tl::unexpected(scenery.error());
  const auto best =
      best_of(*scenery, sought.camera.registration, progress).and_then([&](const Outcome& outcome) {
        return refined(*scenery, sought, outcome.rotation);
      });
  if (!best) return tl::unexpected(best.error());
  const Place& place = best->fit.place;
  const auto ball = turned(sought, place.rotation, place.outline);
  if (!ball) return tl::unexpected(ball.error());
  const double share = overlap(reference.ball, reference.picture.width, reference.picture.height,
                               *ball, sought.picture.width, sought.picture.height);
  const Mat3 covariance = turn_covariance(best->fit.covariance);
  return trusted(
      {place.rotation, place.outline, residual(covariance), share, best->inliers, covariance},
      kLeastEdges);
}

}  // namespace orbwatch::align
