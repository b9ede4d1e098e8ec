// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>

#include "proc/image/result.h"
#include "proc/optics/ball_model.h"
#include "proc/optics/lanes.h"
#include "proc/optics/lens.h"
#include "proc/optics/outline.h"
#include "proc/optics/scene_proxy.h"
#include "proc/optics/vec.h"
#include "proc/optics/window.h"

namespace orbwatch::optics {

/// A camera's pose: x_camera = rotation (X - position). The rotation's rows are the camera's axes
/// (right, down, forward) in the machine frame; position in mm.
struct Pose {
  Mat3 rotation;
  Vec3 position;
};

/// A camera whose lens and pose are known.
struct CalibratedCamera {
  Lens lens;
  Pose pose;
  std::optional<Window> window;
};

/// One camera's projection of the room by the ball. Reentrant, immutable.
///
/// Directions are unit vectors from the ball's centre in the reference (machine) frame. With a
/// scene proxy a direction is that of the machine's point there, so that cameras agree; else, and
/// for models without parallax, the room is far away. Occlusion of one part of the scene by
/// another, as seen from the ball's surface but not from its centre, is not modelled.
class BallProjection {
 public:
  /// An uncalibrated camera: the limb in its picture and a registration. It is on +Y of the ball
  /// and looks along -Y, image right = -X, image up = +Z; v_reference = registration v_camera.
  /// Error: not an ellipse, not a rotation.
  static Result<BallProjection> make(const BallModel& model, const Outline& outline,
                                     const Mat3& registration, const Ball& ball = {},
                                     const SceneProxy& proxy = {});

  /// A calibrated camera. Error: not a rotation, numbers that are not finite, a camera inside of
  /// the ball, a ball behind the lens, a bad window.
  static Result<BallProjection> make(BallModel::Kind kind, const CalibratedCamera& camera,
                                     const Ball& ball, const SceneProxy& proxy = {});

  /// The pixel that shows `direction`; nullopt in the blind cone. It may lie outside the picture
  /// when the picture cuts the ball.
  std::optional<Vec2> pixel(const Vec3& direction) const;

  /// The same for a point there at `closeness` = ball radius / distance from the ball's centre,
  /// instead of the proxy's. Smooth in both, also slightly beyond closeness 0.
  std::optional<Vec2> pixel(const Vec3& direction, double closeness) const;

  /// The same for kLanes directions; NaN for nullopt.
  void pixels(const Vec3Lanes& directions, const Lanes& closeness, Vec2Lanes& out) const;

  /// The reflected ray of `pixel`: it starts on the ball, machine frame, mm. nullopt outside the
  /// limb.
  std::optional<Ray> ray(const Vec2& pixel) const;

  /// The direction to the point where the ray of `pixel` meets the scene. nullopt outside the limb.
  std::optional<Vec3> direction(const Vec2& pixel) const;

  /// The limb in the picture; nullopt when the lens does not show all of it.
  std::optional<Outline> outline() const;

  /// Direction from the ball's centre towards the camera: the best-resolved one.
  const Vec3& facing() const { return viewpoint_.facing; }
  /// Distance from the camera to the ball's centre in ball radii; infinite for an orthographic one.
  double distance() const { return viewpoint_.distance; }
  const SceneProxy& proxy() const { return proxy_; }
  const Ball& ball() const { return ball_; }

 private:
  /// The camera relative to the ball; behind a window, its apparent place for one of its rays.
  ///
  /// The ball's picture consists of places across the axis: rho times the unit vector, in the
  /// machine frame, from the axis towards the thing shown. A place is the camera ray's offset from
  /// the axis as a share of the limb's.
  struct Viewpoint {
    Vec3 facing;
    double distance;  ///< ball radii
    BallModel model;
    double tan_limb;  ///< tan psi_max; 0 for an orthographic camera

    Viewpoint(const Vec3& unit_facing, double distance_in_radii, const BallModel& ball_model);
    /// For a camera at `offset` from the ball's centre, ball radii.
    Viewpoint(const Vec3& offset, BallModel::Kind kind);

    /// A place as a direction's part across the axis and its factor.
    struct Scaled {
      Vec3 across;
      Stretch stretch;
    };
    std::optional<Scaled> place(const Vec3& direction, double closeness) const;
    /// Lanes with `along` above 0 are shown.
    struct ScaledLanes {
      Vec3Lanes across;
      StretchLanes stretch;
    };
    void places(const Vec3Lanes& directions, const Lanes& closeness, ScaledLanes& out) const;
    /// Camera ray, not normalised.
    Vec3 camera_ray(const Scaled& place) const {
      return place.across * (place.stretch.across * tan_limb) - facing * place.stretch.along;
    }
    std::optional<Vec3> place_of_camera_ray(const Vec3& ray) const;
    /// The ray that leaves the ball there, relative to its centre, in ball radii.
    std::optional<Ray> reflected(const Vec3& place) const;
  };

  /// Places in a picture without calibration: a linear map onto the limb's ellipse.
  struct LimbPicture {
    LimbPicture(const Outline& limb, const Mat3& registration);

    Vec2 pixel(const Viewpoint::Scaled& place) const {
      const double scale = place.stretch.across / place.stretch.along;
      return {outline.centre.u + dot(u, place.across) * scale,
              outline.centre.v + dot(v, place.across) * scale};
    }
    Vec3 place(const Vec2& pixel) const;

    Outline outline;
    Vec3 u, v;  ///< pixels per place
    Vec3 place_per_u, place_per_v;
  };

  BallProjection(const Viewpoint& viewpoint,
                 const std::variant<LimbPicture, CalibratedCamera>& picture, const Ball& ball,
                 const SceneProxy& proxy);

  Viewpoint seen_from(const Vec3& position) const;
  std::optional<Vec2> pixel_through_window(const CalibratedCamera& camera, const Vec3& direction,
                                           double closeness) const;
  std::optional<Ray> reflected(const Vec2& pixel) const;

  Viewpoint viewpoint_;
  std::variant<LimbPicture, CalibratedCamera> picture_;
  Ball ball_;
  SceneProxy proxy_;
};

}  // namespace orbwatch::optics
