#include "proc/optics/ball_projection.h"

#include <cmath>
#include <string>

#include "proc/optics/angle.h"
#include "proc/optics/rotation.h"

namespace orbwatch::optics {

Result<> check_outline(const Outline& outline, int picture_width, int picture_height) {
  const Vec2& c = outline.centre;
  if (c.u >= -0.5 && c.u <= picture_width - 0.5 && c.v >= -0.5 && c.v <= picture_height - 0.5) {
    return {};
  }
  return fail("the ball's centre (" + std::to_string(c.u) + ", " + std::to_string(c.v) +
              ") is outside of the picture, which is " + std::to_string(picture_width) + "x" +
              std::to_string(picture_height));
}

Result<BallProjection> BallProjection::make(const BallModel& model, const Outline& outline,
                                            const Mat3& registration) {
  if (!std::isfinite(outline.centre.u) || !std::isfinite(outline.centre.v) ||
      !std::isfinite(outline.angle)) {
    return fail("the ball's centre and angle must be finite numbers");
  }
  if (!(outline.rx > 0) || !(outline.ry > 0) || !std::isfinite(outline.rx + outline.ry)) {
    return fail("the ball's radius must be above 0 pixels");
  }
  auto rotation = checked_rotation(registration);
  if (!rotation) return tl::unexpected(rotation.error());
  return BallProjection(model, outline, *rotation);
}

BallProjection::BallProjection(const BallModel& model, const Outline& outline,
                               const Mat3& registration)
    : model_(model),
      outline_(outline),
      camera_to_reference_(registration),
      reference_to_camera_(transposed(registration)) {
  const double c = std::cos(radians(outline.angle)), s = std::sin(radians(outline.angle));
  stretch_uu_ = outline.rx * c * c + outline.ry * s * s;
  stretch_uv_ = (outline.rx - outline.ry) * c * s;
  stretch_vv_ = outline.rx * s * s + outline.ry * c * c;
}

std::optional<Vec2> BallProjection::pixel(const Vec3& direction) const {
  const Vec3 v = reference_to_camera_ * direction;
  const double across = std::hypot(v.x, v.z);
  const double rho = model_.rho(std::atan2(across, v.y));
  if (std::isnan(rho)) return std::nullopt;
  const double scale = across > 0 ? rho / across : 0;
  const double right = -v.x * scale, down = -v.z * scale;
  return Vec2{outline_.centre.u + stretch_uu_ * right + stretch_uv_ * down,
              outline_.centre.v + stretch_uv_ * right + stretch_vv_ * down};
}

std::optional<Vec3> BallProjection::direction(const Vec2& pixel) const {
  const double u = pixel.u - outline_.centre.u, v = pixel.v - outline_.centre.v;
  const double area = outline_.rx * outline_.ry;
  const double right = (stretch_vv_ * u - stretch_uv_ * v) / area;
  const double down = (stretch_uu_ * v - stretch_uv_ * u) / area;
  const double rho = std::hypot(right, down);
  const double phi = model_.phi(rho);
  if (std::isnan(phi)) return std::nullopt;
  const double scale = rho > 0 ? std::sin(phi) / rho : 0;
  return camera_to_reference_ * Vec3{-right * scale, std::cos(phi), -down * scale};
}

}  // namespace orbwatch::optics
