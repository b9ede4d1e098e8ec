// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/lens.h"
#include "proc/optics/outline.h"
#include "proc/optics/vec.h"
#include "proc/optics/window.h"

/// Places cameras in the machine by known points that the ball shows. Frames, pixels and angles
/// follow proc/optics; lengths in mm, machine frame.
namespace orbwatch::align {

/// A known point marked in the ball's picture.
struct PointMark {
  std::size_t point = 0;  ///< index into PlaceRequest::points
  optics::Vec2 pixel;
};

/// A camera whose pose is unknown.
struct UnplacedCamera {
  std::string name;            ///< for messages
  optics::Intrinsics lens;     ///< only width and height are used if the focal length is unknown
  bool focal_unknown = false;  ///< fx = fy, no distortion, principal point in the picture's middle
  std::optional<optics::Window> window;
  optics::Outline outline;   ///< the ball's limb
  double outline_sigma = 1;  ///< px, for its centre's coordinates and its mean radius
  std::vector<PointMark> marks;
};

/// Prior knowledge of the ball's centre.
struct BallCentre {
  enum class Knowledge { Known, Measured, Unknown };
  Knowledge knowledge = Knowledge::Known;
  optics::Vec3 position;  ///< not used when unknown
  double sigma = 0;       ///< standard deviation of each coordinate, when measured
};

struct PlaceRequest {
  BallCentre centre;
  double ball_radius = 0;
  std::vector<optics::Vec3> points;  ///< each once, however many cameras show it
  double sigma_px = 1;               ///< standard deviation of a mark's coordinates
  double sigma_mm = 0;               ///< standard deviation of a point's coordinates; 0: exact
  std::vector<UnplacedCamera> cameras;
};

/// Result for a mark.
struct PlacedMark {
  /// px, marked minus predicted by the placed camera; none if the ball does not show the point
  /// there, which happens to outliers only.
  std::optional<optics::Vec2> residual;
  bool is_outlier = false;  ///< contradicts the others: left out of the solution
};

struct PlacedCamera {
  optics::Pose pose;
  optics::Intrinsics lens;
  /// Covariance of a small rotation about the camera's axes (rad: x_camera = exp(turn) R (X - C))
  /// and of the position (mm), including their correlation. To first order: too narrow across its
  /// long axis when the focal length was unknown and is determined to some percent only.
  cv::Matx66d covariance;
  double rotation_sigma = 0;          ///< degrees: the rms angle of that rotation
  double direction_sigma = 0;         ///< degrees: see view_sigma()
  std::optional<double> focal_sigma;  ///< px, if the focal length was unknown
  std::vector<PlacedMark> marks;      ///< in the request's order
};

struct Placement {
  optics::Vec3 ball_centre;
  cv::Matx33d ball_centre_covariance;  ///< mm^2; 0 if known
  double reduced_chi_square = 0;       ///< about 1 if the sigmas are right
  int redundancy = 0;                  ///< number of equations less the number of unknowns
  std::vector<PlacedCamera> cameras;
};

/// Index of the point in the request; appends it if it is new. Reentrant.
std::size_t add_point(PlaceRequest& request, const optics::Vec3& point);

/// Least number of marks over all cameras, and for each: one equation more than unknowns, without
/// which no mistake would show.
std::size_t least_marks(const PlaceRequest& request);
inline constexpr std::size_t kLeastMarksPerCamera = 2;

/// Computes the poses of all cameras, with the ball's centre and the focal lengths that are
/// unknown: the least-squares solution for marks, outlines, the measured centre and the points'
/// coordinates, each weighted by its sigma, through the exact model at finite distances. Marks that
/// contradict the rest (chi-square with 2 degrees of freedom, one false alarm in 10000 requests)
/// are left out one by one. Takes some milliseconds, a second when much is unknown. Reentrant.
///
/// Error, naming camera and point: numbers that are not finite or sigmas that are not above 0, too
/// few marks, marks farther outside of the outline than three sigmas of both, points within the
/// ball or that it cannot show, marks that do not determine the unknowns or fit two solutions,
/// marks that contradict one another so that none can be identified as wrong.
Result<Placement> place(const PlaceRequest& request);

}  // namespace orbwatch::align
