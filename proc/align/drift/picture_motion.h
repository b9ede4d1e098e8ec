// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/optics/outline.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// Motion of a part of a picture: a similarity about the centre of the ball's stored outline. A
/// point at `arm` from it moves to arm + at(arm). Pixels, u right, v down.
struct PictureMotion {
  double u = 0;       ///< px, shift of the centre
  double v = 0;       ///< px
  double growth = 0;  ///< relative change of size
  double roll = 0;  ///< radians from u towards v, for a small turn; exact with growth: (1 + growth,
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

/// The outline in pixels that are `scale` times larger.
optics::Outline reduced(const optics::Outline& outline, int scale);

/// Place of `pixel` before a motion of a picture with that outline.
optics::Vec2 before(const PictureMotion& motion, const optics::Outline& outline,
                    const optics::Vec2& pixel);

/// Place of `pixel` after the motion.
optics::Vec2 after(const PictureMotion& motion, const optics::Outline& outline,
                   const optics::Vec2& pixel);

/// The outline after the motion.
optics::Outline moved(const optics::Outline& outline, const PictureMotion& motion);

}  // namespace orbwatch::align
