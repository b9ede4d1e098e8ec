// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/picture_motion.h"

#include <cmath>

namespace orbwatch::align {

using optics::Outline;
using optics::Vec2;

Outline reduced(const Outline& outline, int scale) {
  const auto smaller = [&](double at) { return (at + 0.5) / scale - 0.5; };
  return {{smaller(outline.centre.u), smaller(outline.centre.v)},
          outline.rx / scale,
          outline.ry / scale,
          outline.angle};
}

Vec2 before(const PictureMotion& motion, const Outline& outline, const Vec2& pixel) {
  const Vec2 arm{pixel.u - outline.centre.u - motion.u, pixel.v - outline.centre.v - motion.v};
  const double a = 1 + motion.growth, b = motion.roll, square = a * a + b * b;
  return {outline.centre.u + (a * arm.u + b * arm.v) / square,
          outline.centre.v + (a * arm.v - b * arm.u) / square};
}

Vec2 after(const PictureMotion& motion, const Outline& outline, const Vec2& pixel) {
  const Vec2 way = motion.at({pixel.u - outline.centre.u, pixel.v - outline.centre.v});
  return {pixel.u + way.u, pixel.v + way.v};
}

Outline moved(const Outline& outline, const PictureMotion& motion) {
  const double scale = std::hypot(1 + motion.growth, motion.roll);
  return {{outline.centre.u + motion.u, outline.centre.v + motion.v},
          outline.rx * scale,
          outline.ry * scale,
          outline.angle + optics::degrees(std::atan2(motion.roll, 1 + motion.growth))};
}

}  // namespace orbwatch::align
