#pragma once

#include "proc/optics/outline.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// How a part of a picture moved: a similarity about the centre of the ball's stored outline. What
/// stood at `arm` from it stands at arm + at(arm) now. Pixels, u right, v down.
struct PictureMotion {
  double u = 0;       ///< px, of the centre
  double v = 0;       ///< px
  double growth = 0;  ///< share of the size
  double roll = 0;  ///< radians from u towards v, of a small turn; exact with growth: (1 + growth,
                    ///< roll) is scale times (cosine, sine)

  optics::Vec2 at(const optics::Vec2& arm) const {
    return {u + growth * arm.u - roll * arm.v, v + growth * arm.v + roll * arm.u};
  }

  friend PictureMotion operator-(const PictureMotion& a, const PictureMotion& b) {
    return {a.u - b.u, a.v - b.v, a.growth - b.growth, a.roll - b.roll};
  }
  friend PictureMotion operator+(const PictureMotion& a, const PictureMotion& b) {
    return {a.u + b.u, a.v + b.v, a.growth + b.growth, a.roll + b.roll};
  }
};

inline PictureMotion scaled(const PictureMotion& m, double factor) {
  return {m.u * factor, m.v * factor, m.growth * factor, m.roll * factor};
}

/// The same motion in pixels that are `factor` times smaller.
inline PictureMotion magnified(const PictureMotion& m, double factor) {
  return {m.u * factor, m.v * factor, m.growth, m.roll};
}

/// Where `pixel` stood before a motion of a picture with that outline.
optics::Vec2 before(const PictureMotion& motion, const optics::Outline& outline,
                    const optics::Vec2& pixel);

/// Where `pixel` stands after it.
optics::Vec2 after(const PictureMotion& motion, const optics::Outline& outline,
                   const optics::Vec2& pixel);

/// The outline after it.
optics::Outline moved(const optics::Outline& outline, const PictureMotion& motion);

}  // namespace orbwatch::align
