// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "proc/align/place/placement.h"
#include "tests/proc/reference_optics.h"

/// Cameras, a ball and points of a machine, by plain vectors: shortest paths over the mirror,
/// tangents to the ball, reflected rays. Nothing of the product's ball models is used.
namespace orbwatch::tests {

/// A pinhole camera without distortion, square pixels. The pose is that of optics::Pose, mm.
struct RigCamera {
  optics::Pose pose;
  double focal = 1;
  int width = 0;
  int height = 0;

  optics::Vec2 middle() const { return {(width - 1) / 2.0, (height - 1) / 2.0}; }
  optics::Intrinsics lens() const { return {width, height, focal, focal, middle().u, middle().v}; }
};

struct MirroredRig {
  optics::Vec3 centre;  ///< the ball's, mm
  double radius = 50;   ///< mm
  std::vector<RigCamera> cameras;
  std::vector<optics::Vec3> points;  ///< mm
};

/// The pixel that shows the point by the shortest path over the ball; NaN when none does.
optics::Vec2 seen_at(const RigCamera& camera, const optics::Vec3& centre, double radius,
                     const optics::Vec3& point);

/// The ellipse of the tangents to the ball, with its centre and half axes.
struct SeenLimb {
  optics::Vec2 centre;
  double rx = 0, ry = 0, angle = 0;
};
SeenLimb limb_of(const RigCamera& camera, const optics::Vec3& centre, double radius);

/// The direction, machine frame, of the ray that the ball reflects into a pixel; NaN beyond the
/// limb.
optics::Vec3 direction_at(const RigCamera& camera, const optics::Vec3& centre, double radius,
                          const optics::Vec2& pixel);

/// Requirements for a random rig.
struct RigWishes {
  int cameras = 1;
  int points = 6;
  double least_radius = 150;  ///< px, radius of the ball's picture
  double most_radius = 900;
};

/// A random rig: cameras around the ball, off its axis, rolled; points all around at 3 to 12 radii,
/// which every camera's ball shows well inside of its limb.
MirroredRig random_rig(std::mt19937_64& random, const RigWishes& wishes);

/// Standard deviations of the measurements.
struct Noise {
  double px = 0.5;
  double outline_px = 0.5;
  double mm = 0;         ///< points' coordinates
  double centre_mm = 0;  ///< the ball's centre, when it is measured
};

/// The request of an operator: all points marked in all cameras, with normal errors.
align::PlaceRequest request_of(const MirroredRig& rig, const Noise& noise,
                               align::BallCentre::Knowledge knowledge, bool focal_unknown,
                               std::mt19937_64& random);

/// Error of a placement: per camera a small rotation about its axes (rad) and the position (mm), in
/// the order of PlacedCamera::covariance.
Eigen::Matrix<double, 6, 1> pose_error(const RigCamera& truth, const optics::Pose& placed);

/// Degrees, rms over the directions within 150 degrees of the camera that its picture shows:
/// difference of a true pixel's direction when the placed camera's projection is used for it.
double direction_error(const MirroredRig& rig, std::size_t camera,
                       const align::Placement& placement);

/// The least rms of direction_error() for any unbiased method (Cramer and Rao): the inverse of the
/// information in marks, outlines, a measured centre and the points' coordinates, with slopes of
/// this file's functions.
double least_direction_error(const MirroredRig& rig, const Noise& noise,
                             align::BallCentre::Knowledge knowledge, bool focal_unknown,
                             std::size_t camera);

}  // namespace orbwatch::tests
