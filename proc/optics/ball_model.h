#pragma once

#include <optional>

#include "proc/image/result.h"
#include "proc/optics/alhazen.h"
#include "proc/optics/lanes.h"

namespace orbwatch::optics {

/// An angle by its cosine and sine: what reflection needs of it.
struct CosSin {
  double cos = 1;
  double sin = 0;
};

/// How a direction in space and a place on the ball's picture belong together for a camera that
/// looks at the ball's centre: a law between two numbers, because everything turns about that axis.
///
/// phi, in [0, pi]: angle of a direction, seen from the ball's centre, from the direction ball ->
/// camera. rho: distance from the centre of the ball's picture as a share of its limb's radius,
/// tan psi / tan psi_max for the camera ray's angle psi from the axis. Reentrant, immutable.
class BallModel {
 public:
  /// Names as the command line and the configuration file write them.
  enum class Kind { Exact, Paper, Classical };

  /// Reflection on a sphere as a perspective camera sees it. `alpha`, degrees, (180, 360]: the
  /// reflected field of view, 360 minus the ball's apparent diameter.
  static Result<BallModel> exact(double alpha);

  /// The paper's term: rho = sin(phi/2) / sin(alpha/4); directions beyond alpha/2 are undefined.
  static Result<BallModel> paper(double alpha);

  /// The orthographic camera: rho = sin(phi/2), the whole sphere.
  static BallModel classical();

  /// The model of that kind from what a user gives. Error: the classical model takes neither alpha
  /// nor distance, the others exactly one of them.
  static Result<BallModel> make(Kind kind, std::optional<double> alpha,
                                std::optional<double> distance);

  /// The model of that kind for a camera `distance` ball radii away, > 1, which is not checked.
  /// The classical model takes it to be infinite.
  static BallModel at_distance(Kind kind, double distance);

  /// alpha in degrees for a camera `distance` ball radii away from the ball's centre, > 1.
  static Result<double> alpha_from_distance(double distance);

  /// The inverse; infinite for 360 degrees.
  static Result<double> distance_from_alpha(double alpha);

  /// A fraction, so that who divides later anyway need not do it twice.
  struct Stretch {
    double across;
    double along;
  };
  /// rho / sin(phi) of what lies in direction phi; nothing when the ball does not show it. `along`
  /// is 0 straight behind the ball of an orthographic camera, where rho is 1. The square of the
  /// sine is given too, since near the axis the cosine does not tell it. `closeness`, in [0, 1]:
  /// ball radius / distance of that point from the ball's centre; 0 is far away, as the paper's and
  /// the classical model take everything to be.
  std::optional<Stretch> stretch(double cos_phi, double sin2_phi, double closeness = 0) const;

  struct StretchLanes {
    Lanes across;
    Lanes along;
  };
  /// The same for many; `along` is not a number where it gives nothing.
  void stretch(const Lanes& cos_phi, const Lanes& sin2_phi, const Lanes& closeness,
               StretchLanes& out) const;

  /// phi of where the ray goes that rho shows, the inverse of stretch() far away; nothing outside
  /// the limb.
  std::optional<CosSin> phi(double rho) const;

  /// The angle theta from the axis under which that ray leaves the ball, seen from its centre; for
  /// the exact model and a rho within the limb.
  CosSin theta(double rho) const;

  /// Largest phi that is shown far away, radians: alpha/2, or pi for the classical model.
  double limit() const;

  /// Camera to the ball's centre in ball radii; infinite for an orthographic camera.
  double distance() const { return 1 / q_; }

  Kind kind() const { return kind_; }

 private:
  // A direction exactly on the limb must not fall outside by rounding.
  static constexpr double kLimbTolerance = 1e-12;

  BallModel(Kind kind, double q);

  bool is_shown(double cos_phi, double closeness) const;
  Stretch stretch_at(const HalfAngle& h, const Offset& delta) const;
  CosSin incidence(double rho) const;  // within the limb

  Kind kind_;
  double q_;         ///< ball radius / distance of the camera = sin(alpha/2) = sin psi_max
  double cos_limb_;  ///< cos psi_max = -cos(alpha/2)
  double widest_;    ///< the paper's sin(alpha/4)
};

inline std::optional<BallModel::Stretch> BallModel::stretch(double cos_phi, double sin2_phi,
                                                            double closeness) const {
  if (kind_ != Kind::Exact) {
    if (!(cos_phi >= -cos_limb_ - kLimbTolerance)) return std::nullopt;
    return Stretch{1, 2 * half(cos_phi, sin2_phi).cos * widest_};
  }
  if (!is_shown(cos_phi, closeness)) return std::nullopt;
  const HalfAngle h = half(cos_phi, sin2_phi);
  return stretch_at(h, bisector_offset(h, closeness, q_));
}

/// By the exact model. Without a branch, as all below: for loops over many.
inline bool BallModel::is_shown(double cos_phi, double closeness) const {
  const double p = closeness;
  // On the limb the ray grazes the ball: phi = acos p + acos q.
  const double beyond = p * q_ - cos_phi, limb2 = cos_limb_ * cos_limb_ * (1 - p) * (1 + p);
  return (p <= 1) & ((beyond <= 0) | (beyond * beyond <= limb2 + kLimbTolerance));
}

inline BallModel::Stretch BallModel::stretch_at(const HalfAngle& h, const Offset& delta) const {
  // The normal there; its sine is that of h times `sine`.
  const double cosine = h.cos * delta.cos - h.sin2 * delta.share;
  const double sine = delta.cos + h.cos * delta.share;
  return {cos_limb_ * sine, 2 * h.cos * (1 - q_ * cosine)};
}

}  // namespace orbwatch::optics
