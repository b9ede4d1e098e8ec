// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/view_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace orbwatch::optics {
namespace {

// Least field of view; a pixel's step would vanish in the directions' rounding below it.
constexpr double kLeastFov = 1e-6;

// Size of a Ball view relative to the limb's bounding box: alignment needs to see the limb.
constexpr double kCropMargin = 1.02;
// Relative difference up to which a Ball view's pixels are replaced by its camera's: nothing is
// interpolated then, and half of the margin is left.
constexpr double kOwnPixel = 0.01;

// Keeps a pixel exactly on a fisheye's end from falling beyond it by rounding.
constexpr double kHalfTurn = std::numbers::pi * (1 + 1e-12);

struct Limit {
  double degrees;
  bool included;
};

struct FieldOfView {
  double h_default;
  Limit h;
  Limit v;
};

/// Sorted in the order of ViewKind.
constexpr std::array<FieldOfView, 6> kFieldsOfView{{
    {90, {180, false}, {180, false}},   // Perspective
    {360, {360, true}, {180, true}},    // Equirectangular
    {360, {360, true}, {180, false}},   // Cylindrical
    {180, {360, false}, {360, false}},  // Stereographic
    {180, {360, true}, {360, true}},    // Fisheye
    {},                                 // Ball
}};

constexpr const FieldOfView& field_of_view(ViewKind kind) {
  return kFieldsOfView[static_cast<std::size_t>(kind)];
}

Result<> check_angle(const char* name, std::optional<double> value, Limit limit) {
  if (!value || (*value >= kLeastFov &&
                 (*value < limit.degrees || (limit.included && *value == limit.degrees)))) {
    return {};
  }
  return fail(std::string("the view's ") + name + " is " + std::to_string(*value) +
              " degrees; it must be above 0 and " + (limit.included ? "at most " : "below ") +
              std::to_string(static_cast<int>(limit.degrees)));
}

/// Distance from a picture's middle to its edge, in the projection's own measure.
double reach(ViewKind kind, bool vertical, double fov) {
  if (kind == ViewKind::Stereographic) return std::tan(radians(fov / 4));
  const bool tangent = kind == ViewKind::Perspective || (kind == ViewKind::Cylindrical && vertical);
  return tangent ? std::tan(radians(fov / 2)) : radians(fov / 2);
}

Vec3 perspective(const Mat3& orientation, double x, double y) {
  return orientation * normalized({x, 1, y});
}

Vec3 from_longitude(double longitude, double along, double up) {
  return {along * std::sin(longitude), along * std::cos(longitude), up};
}

}  // namespace

Result<> check_view(const ViewSpec& spec) {
  const auto good = [](int side) { return side >= 1 && side <= kMaxSide; };
  if (!good(spec.width) || !good(spec.height)) {
    return fail("the view's size is " + std::to_string(spec.width) + "x" +
                std::to_string(spec.height) + "; each side must be 1 to " +
                std::to_string(kMaxSide));
  }
  const YawPitchRoll& angles = spec.orientation;
  if (!std::isfinite(angles.yaw + angles.pitch + angles.roll)) {
    return fail("the view's yaw, pitch and roll must be finite numbers");
  }
  if (spec.kind == ViewKind::Ball) {
    if (spec.h_fov || spec.v_fov || angles.yaw != 0 || angles.pitch != 0 || angles.roll != 0) {
      return fail("a ball's own picture takes no yaw, pitch, roll, h_fov or v_fov");
    }
    return {};
  }
  const FieldOfView limits = field_of_view(spec.kind);
  return check_angle("h_fov", spec.h_fov, limits.h).and_then([&] {
    return check_angle("v_fov", spec.v_fov, limits.v);
  });
}

double h_fov_of(const ViewSpec& spec) {
  return spec.h_fov.value_or(field_of_view(spec.kind).h_default);
}

Result<ViewProjection> ViewProjection::make(const ViewSpec& spec) {
  if (auto ok = check_view(spec); !ok) return tl::unexpected(ok.error());
  if (spec.kind == ViewKind::Ball) {
    return fail("a ball's own picture belongs to a camera: name one");
  }
  return ViewProjection(spec);
}

Result<ViewProjection> ViewProjection::make(const ViewSpec& spec, const BallProjection& ball) {
  if (spec.kind != ViewKind::Ball) return make(spec);
  if (auto ok = check_view(spec); !ok) return tl::unexpected(ok.error());
  ViewProjection view(spec);
  if (auto ok = view.crop(ball); !ok) return tl::unexpected(ok.error());
  return view;
}

Result<ViewProjection> ViewProjection::whole_picture(const BallProjection& ball, int width,
                                                     int height) {
  const ViewSpec spec{ViewKind::Ball, {}, {}, {}, width, height};
  if (auto ok = check_view(spec); !ok) return tl::unexpected(ok.error());
  ViewProjection view(spec);
  view.step_u_ = view.step_v_ = 1;
  view.crop_centre_ = {(width - 1) / 2.0, (height - 1) / 2.0};
  view.ball_ = ball;
  return view;
}

ViewProjection::ViewProjection(const ViewSpec& spec)
    : spec_(spec), orientation_(rotation(spec.orientation)) {
  if (spec_.kind == ViewKind::Ball) return;
  step_u_ = 2 * reach(spec_.kind, false, h_fov_of(spec)) / spec_.width;
  if (spec.v_fov || spec_.kind == ViewKind::Equirectangular) {
    step_v_ = 2 * reach(spec_.kind, true, spec.v_fov.value_or(180)) / spec_.height;
  } else {
    step_v_ = step_u_;
  }
}

Result<> ViewProjection::crop(const BallProjection& ball) {
  const auto limb = ball.outline();
  if (!limb) return fail("the camera's lens does not show all of the ball's limb");
  const double c = std::cos(radians(limb->angle)), s = std::sin(radians(limb->angle));
  const double half_width = std::hypot(limb->rx * c, limb->ry * s);
  const double half_height = std::hypot(limb->rx * s, limb->ry * c);
  step_u_ = step_v_ =
      2 * kCropMargin * std::max(half_width / spec_.width, half_height / spec_.height);
  crop_centre_ = limb->centre;
  if (std::abs(step_u_ - 1) <= kOwnPixel) {
    const double u = (spec_.width - 1) / 2.0, v = (spec_.height - 1) / 2.0;
    step_u_ = step_v_ = 1;
    crop_centre_ = {std::round(limb->centre.u - u) + u, std::round(limb->centre.v - v) + v};
  }
  ball_ = ball;
  return {};
}

Vec2 ViewProjection::camera_pixel(double u, double v) const {
  return {crop_centre_.u + (u - (spec_.width - 1) / 2.0) * step_u_,
          crop_centre_.v + (v - (spec_.height - 1) / 2.0) * step_v_};
}

Vec2 ViewProjection::of_camera_pixel(const Vec2& pixel) const {
  return {(spec_.width - 1) / 2.0 + (pixel.u - crop_centre_.u) / step_u_,
          (spec_.height - 1) / 2.0 + (pixel.v - crop_centre_.v) / step_v_};
}

std::optional<Vec3> ViewProjection::direction(double u, double v) const {
  const double x = (u - (spec_.width - 1) / 2.0) * step_u_;
  const double y = ((spec_.height - 1) / 2.0 - v) * step_v_;
  switch (spec_.kind) {
    case ViewKind::Perspective:
      return perspective(orientation_, x, y);
    case ViewKind::Equirectangular:
      return orientation_ * from_longitude(x, std::cos(y), std::sin(y));
    case ViewKind::Cylindrical: {
      const double cosine = 1 / std::sqrt(1 + y * y);
      return orientation_ * from_longitude(x, cosine, y * cosine);
    }
    case ViewKind::Stereographic: {
      const double r2 = x * x + y * y;
      return orientation_ * (Vec3{2 * x, 1 - r2, 2 * y} * (1 / (1 + r2)));
    }
    case ViewKind::Fisheye: {
      const double theta = std::hypot(x, y);
      if (theta > kHalfTurn) return std::nullopt;
      const double scale = theta > 0 ? std::sin(theta) / theta : 1;
      return orientation_ * Vec3{x * scale, std::cos(theta), y * scale};
    }
    case ViewKind::Ball:
      break;
  }
  return ball_->direction(camera_pixel(u, v));
}

void ViewProjection::directions(const Vec2Lanes& pixels, Vec3Lanes& out) const {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  if (spec_.kind != ViewKind::Perspective) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      out.set(k, direction(pixels.u[k], pixels.v[k]).value_or(Vec3{kNothing, kNothing, kNothing}));
    }
    return;
  }
  // Copies, so that no store into `out` could change them.
  const Mat3 orientation = orientation_;
  const Vec2 middle{(spec_.width - 1) / 2.0, (spec_.height - 1) / 2.0}, step{step_u_, step_v_};
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double x = (pixels.u[k] - middle.u) * step.u, y = (middle.v - pixels.v[k]) * step.v;
    out.set(k, perspective(orientation, x, y));
  }
}

std::optional<Vec2> ViewProjection::pixel(const Vec3& direction) const {
  const auto at = [&](double x, double y) {
    return Vec2{(spec_.width - 1) / 2.0 + x / step_u_, (spec_.height - 1) / 2.0 - y / step_v_};
  };
  const Vec3 d = transposed(orientation_) * direction;
  const double along = std::hypot(d.x, d.y), across = std::hypot(d.x, d.z);
  switch (spec_.kind) {
    case ViewKind::Perspective:
      if (!(d.y > 0)) return std::nullopt;
      return at(d.x / d.y, d.z / d.y);
    case ViewKind::Equirectangular:
      return at(std::atan2(d.x, d.y), std::atan2(d.z, along));
    case ViewKind::Cylindrical:
      if (!(along > 0)) return std::nullopt;
      return at(std::atan2(d.x, d.y), d.z / along);
    case ViewKind::Stereographic:
      if (!(d.y > -1)) return std::nullopt;
      return at(d.x / (1 + d.y), d.z / (1 + d.y));
    case ViewKind::Fisheye: {
      if (across == 0 && d.y < 0) return std::nullopt;
      const double scale = across > 0 ? std::atan2(across, d.y) / across : 0;
      return at(d.x * scale, d.z * scale);
    }
    case ViewKind::Ball:
      break;
  }
  const auto seen = ball_->pixel(direction);
  if (!seen) return std::nullopt;
  return at(seen->u - crop_centre_.u, crop_centre_.v - seen->v);
}

double ViewProjection::solid_angle(double u, double v) const {
  const double x = (u - (spec_.width - 1) / 2.0) * step_u_;
  const double y = ((spec_.height - 1) / 2.0 - v) * step_v_;
  const double area = step_u_ * step_v_, r2 = x * x + y * y;
  switch (spec_.kind) {
    case ViewKind::Perspective:
      return area / ((1 + r2) * std::sqrt(1 + r2));
    case ViewKind::Equirectangular:
      return step_u_ * 2 * std::sin(step_v_ / 2) * std::max(0.0, std::cos(y));
    case ViewKind::Cylindrical:
      return area / ((1 + y * y) * std::sqrt(1 + y * y));
    case ViewKind::Stereographic:
      return area * 4 / ((1 + r2) * (1 + r2));
    case ViewKind::Fisheye: {
      const double theta = std::sqrt(r2);
      if (theta > std::numbers::pi) return 0;
      return theta > 0 ? area * std::sin(theta) / theta : area;
    }
    case ViewKind::Ball:
      break;
  }
  return ball_solid_angle(u, v);
}

double ViewProjection::ball_solid_angle(double u, double v) const {
  const auto left = direction(u - 0.5, v), right = direction(u + 0.5, v);
  const auto above = direction(u, v - 0.5), below = direction(u, v + 0.5);
  if (!left || !right || !above || !below) return 0;
  return norm(cross(*right - *left, *below - *above));
}

std::optional<Intrinsics> ViewProjection::intrinsics() const {
  if (spec_.kind != ViewKind::Perspective) return std::nullopt;
  Intrinsics of_view;
  of_view.width = spec_.width;
  of_view.height = spec_.height;
  of_view.fx = 1 / step_u_;
  of_view.fy = 1 / step_v_;
  of_view.cx = (spec_.width - 1) / 2.0;
  of_view.cy = (spec_.height - 1) / 2.0;
  return of_view;
}

}  // namespace orbwatch::optics
