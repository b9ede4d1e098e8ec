// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/features/feature_registration.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <optional>

#include "proc/align/detect/picture/luminance.h"
#include "proc/align/register/consensus/refinement.h"
#include "proc/align/register/consensus/rotation_consensus.h"
#include "proc/align/register/features/feature_matches.h"
#include "proc/align/register/sphere_view.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;

constexpr int kLeastMatches = 15;
constexpr double kRivalInliers = 0.5;     // share of the best one's inliers that makes a rival
constexpr double kFinestFeatureView = 4;  // pixels per degree; more costs time and gains little
// Search angle for features after the first estimate.
const double kNeighbourhood = optics::radians(2.5);
constexpr double kParallax = 1.4;  // radians per closeness: cameras see the ball's edges, too

/// Both pictures, prepared for the search.
struct Pictures {
  cv::Mat reference;
  cv::Mat camera;
  double pixels_per_degree;
};

Result<Features> features(const cv::Mat& picture, const BallProjection& ball, double resolution,
                          const std::optional<double>& closeness = {}) {
  return sphere_faces(picture, ball, resolution, closeness)
      .map([&](const std::vector<SphereFace>& faces) {
        return find_features(faces, ball, closeness);
      });
}

/// The sought camera in its own frame, in a room far away.
Result<BallProjection> far_and_unturned(SoughtCamera sought) {
  sought.rig.scene = {};
  return in_own_frame(sought);
}

Result<RotationConsensus> first_estimate(const Pictures& pictures, const Features& seen,
                                         const BallProjection& reference,
                                         const SoughtCamera& sought) {
  const auto ball = far_and_unturned(sought);
  if (!ball) return tl::unexpected(ball.error());
  const auto other = features(pictures.camera, *ball, pictures.pixels_per_degree);
  if (!other) return tl::unexpected(other.error());
  const auto found = agree_on_rotation(match_features(seen, *other), reference, sought);
  if (!found) return found;
  if (static_cast<double>(found->rival) > kRivalInliers * static_cast<double>(found->agreeing)) {
    return fail("two different rotations fit nearly as well, " + std::to_string(found->agreeing) +
                " and " + std::to_string(found->rival) +
                " features agree: put something with patterns where both cameras see it");
  }
  return found;
}

/// Largest angle between the same thing's directions in both cameras; includes the spread of an
/// unstated room.
double neighbourhood(const std::optional<RoomCloseness>& room) {
  return kNeighbourhood + (room ? 2 * kParallax * room->spread : 0);
}

/// Repeats the search with views of the same frame and room, in which features look alike and lie
/// near each other.
Result<RotationRefinement> refined(const Pictures& pictures, const Features& seen,
                                   const BallProjection& reference, const SoughtCamera& sought,
                                   const RefinementState& rough) {
  const auto ball = turned(sought, rough.rotation, rough.outline);
  if (!ball) return tl::unexpected(ball.error());
  const double resolution = pictures.pixels_per_degree;
  std::optional<double> closeness;
  if (rough.room) closeness = std::max(0.0, rough.room->mean);
  const auto other = features(pictures.camera, *ball, resolution, closeness);
  if (!other) return tl::unexpected(other.error());
  const auto again = closeness ? features(pictures.reference, reference, resolution, closeness)
                               : Result<Features>(seen);
  if (!again) return tl::unexpected(again.error());
  const auto matches = match_features(*again, *other, neighbourhood(rough.room));
  return refine_rotation(matches, reference, sought, rough);
}

}  // namespace

Result<Registration> register_by_features(const ReferenceCamera& reference,
                                          const SoughtCamera& sought,
                                          const WorkProgress& progress) {
  const auto unturned = in_own_frame(sought);
  if (!unturned) return tl::unexpected(unturned.error());
  const Pictures pictures{stretched(luminance_of(reference.picture)),
                          stretched(luminance_of(sought.picture)),
                          std::min({kFinestFeatureView, best_resolution(reference.ball),
                                    1.3 * best_resolution(*unturned)})};
  const auto at = [&](double share) { return progress.at(WorkStep::Features, share); };
  const auto seen = at(0).and_then(
      [&] { return features(pictures.reference, reference.ball, pictures.pixels_per_degree); });
  if (!seen) return tl::unexpected(seen.error());
  const auto first =
      at(0.25).and_then([&] { return first_estimate(pictures, *seen, reference.ball, sought); });
  if (!first) return tl::unexpected(first.error());
  const auto rough = at(0.5).and_then([&] {
    return refine_rotation(first->inliers, reference.ball, sought,
                           {first->rotation, *sought.camera.outline, first->room});
  });
  if (!rough) return tl::unexpected(rough.error());
  const auto fine = at(0.75).and_then(
      [&] { return refined(pictures, *seen, reference.ball, sought, rough->state); });
  if (!fine) return tl::unexpected(fine.error());
  const auto ball = turned(sought, fine->state.rotation, fine->state.outline);
  if (!ball) return tl::unexpected(ball.error());
  const double share = overlap(reference.ball, reference.picture.width, reference.picture.height,
                               *ball, sought.picture.width, sought.picture.height);
  return trusted({fine->state.rotation, fine->state.outline, fine->residual, share, fine->inliers,
                  fine->covariance},
                 kLeastMatches);
}

}  // namespace orbwatch::align
