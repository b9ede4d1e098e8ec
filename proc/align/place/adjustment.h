// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "proc/align/place/placement.h"

namespace orbwatch::align {

/// A camera's state in the adjustment. Lengths in ball radii.
struct CameraState {
  optics::Mat3 rotation;  ///< x_camera = rotation (X - C)
  optics::Vec3 ball;      ///< the ball's centre in the camera frame
  double log_focal = 0;   ///< focal length = exp(log_focal) times that of the request's lens
};

/// All unknowns. Lengths in ball radii.
struct PlaceState {
  optics::Vec3 centre;
  std::vector<optics::Vec3> points;
  std::vector<CameraState> cameras;
};

/// The camera's lens with the focal length exp(log_focal) times that of the request's.
Result<optics::Lens> lens_at(const UnplacedCamera& camera, double log_focal);

/// The camera's projection in that state, in ball radii throughout. nullopt if there is none: a
/// camera within the ball, or one that faces away.
std::optional<optics::BallProjection> projection(const UnplacedCamera& camera,
                                                 const optics::Lens& lens, const CameraState& state,
                                                 const optics::Vec3& centre, double ball_radius);

/// Small changes of one camera's state, in this order: rotation about the camera's axes (3, rad),
/// ball in the camera frame (3, radii), logarithm of the focal length (1).
inline constexpr int kCameraUnknowns = 7;
using CameraChange = cv::Vec<double, kCameraUnknowns>;
CameraState changed(const CameraState& state, const CameraChange& change);

/// A mark that takes part.
struct UsedMark {
  std::size_t camera;
  std::size_t mark;
};

/// The equations at a state, each divided by its sigma. Columns: kCameraUnknowns per camera, the
/// ball's centre (3), the points (3 each); columns of known values are 0.
struct Equations {
  cv::Mat1d jacobian;
  std::vector<double> residuals;  ///< first two per used mark, in their order
  std::vector<int> unknowns;      ///< columns of the unknowns

  double sum_of_squares() const;
  /// Number of equations less the number of unknowns.
  int redundancy() const { return int(residuals.size()) - int(unknowns.size()); }
};

/// Least-squares adjustment of a request whose numbers are checked and of which some marks may be
/// left out.
class Adjustment {
 public:
  Adjustment(const PlaceRequest& request, std::vector<UsedMark> used)
      : request_(request), used_(std::move(used)) {}

  /// The least-squares state next to `start`; with `robust`, marks far off have less weight. Points
  /// that the ball cannot show there count as beyond its limb. nullopt if nothing is found.
  std::optional<PlaceState> solve(const PlaceState& start, bool robust) const;

  /// nullopt if they cannot be formed.
  std::optional<Equations> equations(const PlaceState& state) const;

  const std::vector<UsedMark>& used() const { return used_; }

 private:
  const PlaceRequest& request_;
  std::vector<UsedMark> used_;
};

}  // namespace orbwatch::align
