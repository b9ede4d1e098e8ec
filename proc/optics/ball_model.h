// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "proc/image/result.h"
#include "proc/optics/lanes.h"
#include "proc/optics/models/ball_law.h"
#include "proc/settings/settings.h"

/// The ball models, one line each: X(Kind, law). A file in models/ defines laws::law.
#define ORBWATCH_BALL_MODELS(X) \
  X(Exact, exact)               \
  X(Paper, paper)               \
  X(Classical, classical)

namespace orbwatch::optics {

/// The relation between a direction in space and a place on the ball's picture, for a camera that
/// faces the ball's centre: a law between two numbers, because of the symmetry about that axis.
///
/// phi, in [0, pi]: angle of a direction, seen from the ball's centre, from the direction ball ->
/// camera. rho: distance from the centre of the ball's picture as a share of its limb's radius, tan
/// psi / tan psi_max for the camera ray's angle psi from the axis. Reentrant, immutable.
class BallModel {
 public:
#define ORBWATCH_KIND(kind, law) kind,
  enum class Kind { ORBWATCH_BALL_MODELS(ORBWATCH_KIND) };
#undef ORBWATCH_KIND

  /// `alpha`, degrees, (180, 360]: the reflected field of view, 360 minus the ball's apparent
  /// diameter. `distance`: the camera's, ball radii, > 1. Error: not exactly one of them; for an
  /// orthographic model, any of them.
  static Result<BallModel> make(Kind kind, std::optional<double> alpha = {},
                                std::optional<double> distance = {});

  /// The same for a distance > 1, which is not checked and has no effect on an orthographic model.
  static BallModel at_distance(Kind kind, double distance);

  /// rho / sin(phi) of a point in direction phi; nullopt when the ball does not show it. The square
  /// of the sine is passed too, since near the axis the cosine does not determine it. `closeness`,
  /// in [0, 1]: ball radius / distance of that point from the ball's centre; 0 is far away, and the
  /// only value in models without parallax.
  std::optional<Stretch> stretch(double cos_phi, double sin2_phi, double closeness = 0) const {
    return law_->stretch(limb_, cos_phi, sin2_phi, closeness);
  }
  /// The same for kLanes directions; `along` is NaN for nullopt.
  void stretch(const Lanes& cos_phi, const Lanes& sin2_phi, const Lanes& closeness,
               StretchLanes& out) const {
    law_->stretch_lanes(limb_, cos_phi, sin2_phi, closeness, out);
  }

  /// phi of the reflected ray at rho, the inverse of stretch() far away; nullopt outside the limb.
  std::optional<CosSin> phi(double rho) const;

  /// The angle theta from the axis, seen from the ball's centre, at which that ray leaves the ball.
  /// For models with parallax and a rho within the limb.
  CosSin theta(double rho) const;

  /// Largest phi shown far away, radians: alpha/2, or pi for an orthographic camera.
  double limit() const;

  /// Distance from the camera to the ball's centre in ball radii; infinite for an orthographic
  /// camera.
  double distance() const { return 1 / limb_.q; }

  Kind kind() const { return kind_; }
  bool has_parallax() const { return law_->has_parallax; }

 private:
  BallModel(Kind kind, double q);

  Kind kind_;
  const BallLaw* law_;
  Limb limb_;
};

/// The law of a model.
const BallLaw& law(BallModel::Kind kind);

/// The models with their names in files and options.
inline constexpr std::array kBallModels{
#define ORBWATCH_WORD(kind, law) Word{#law, BallModel::Kind::kind},
    ORBWATCH_BALL_MODELS(ORBWATCH_WORD)
#undef ORBWATCH_WORD
};

}  // namespace orbwatch::optics
