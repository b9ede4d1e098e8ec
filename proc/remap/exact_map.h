#pragma once

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/coordinate.h"

namespace orbwatch::remap {

/// The map that a grid approximates, evaluated anew for every question. Reentrant; keeps references
/// to the view and the ball.
class ExactMap {
 public:
  ExactMap(const optics::ViewProjection& view, const optics::BallProjection& ball)
      : view_(view), ball_(ball) {}

  /// Where the view's projection ends: no surface of the scene.
  static constexpr int kNoSurface = -2;

  struct Sight {
    int surface = kNoSurface;  ///< as SceneProxy counts them
    Coordinate coordinate{kBlind, 0};
  };
  /// What pixel (x, y) of the view shows; it may lie outside of the view.
  Sight see(int x, int y) const;

  /// Only the surface.
  int surface(int x, int y) const;

  /// Where (x, y) would be if that surface were seen there. Smooth on each surface.
  Coordinate on_surface(int surface, int x, int y) const;

 private:
  Coordinate coordinate(const optics::Vec3& direction, double closeness) const;

  const optics::ViewProjection& view_;
  const optics::BallProjection& ball_;
};

}  // namespace orbwatch::remap
