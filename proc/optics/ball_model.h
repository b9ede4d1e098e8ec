#pragma once

#include <optional>

#include "proc/image/result.h"

namespace orbwatch::optics {

/// How a direction in space and a place on the ball's picture belong together for a camera that
/// looks at the ball's centre: a law between two numbers, because everything turns about that axis.
///
/// phi, radians: angle of the direction in which the ball shows the room, from the direction ball
/// -> camera. rho: distance from the centre of the ball's picture as a share of its limb's radius.
/// The room is taken to be far away compared with the ball's radius. Reentrant, immutable.
class BallModel {
 public:
  /// Names as the command line and the configuration file write them.
  enum class Kind { Exact, Paper, Classical };

  /// Reflection on a sphere as a perspective camera sees it. `alpha`, degrees, (180, 360]: the
  /// reflected field of view, 360 minus the ball's apparent diameter. Source: law of reflection in
  /// the triangle camera, hit point, centre; phi = 2i - asin(sin i / d) with 1/d = sin(alpha/2).
  static Result<BallModel> exact(double alpha);

  /// The paper's term: rho = sin(phi/2) / sin(alpha/4); directions beyond alpha/2 are undefined.
  static Result<BallModel> paper(double alpha);

  /// The orthographic camera: rho = sin(phi/2), the whole sphere.
  static BallModel classical();

  /// The model of that kind from what a user gives. Error: the classical model takes neither alpha
  /// nor distance, the others exactly one of them.
  static Result<BallModel> make(Kind kind, std::optional<double> alpha,
                                std::optional<double> distance);

  /// alpha in degrees for a camera `distance` ball radii away from the ball's centre, > 1.
  static Result<double> alpha_from_distance(double distance);

  /// rho of a direction, in [0, 1]; NaN when the ball does not show it. phi in [0, pi].
  double rho(double phi) const;

  /// phi of a place on the ball's picture; NaN outside the limb. The inverse of rho().
  double phi(double rho) const;

  /// Largest phi that is shown, radians: alpha/2, or pi for the classical model.
  double limit() const { return limit_; }

  Kind kind() const { return kind_; }

 private:
  BallModel(Kind kind, double alpha);

  double exact_rho(double phi) const;

  Kind kind_;
  double limit_;             ///< alpha / 2, radians
  double inverse_distance_;  ///< ball radius / distance of the camera; 0 for an orthographic one
  double closed_form_;       ///< cos(alpha/4)
  double stretch_;           ///< the paper's sin(alpha/4)
};

}  // namespace orbwatch::optics
