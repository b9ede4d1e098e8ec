#include "proc/optics/view_projection.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "proc/optics/angle.h"

namespace orbwatch::optics {
namespace {

Result<> check_size(const ViewSpec& spec) {
  const auto good = [](int side) { return side >= 1 && side <= kMaxSide; };
  if (good(spec.width) && good(spec.height)) return {};
  return fail("the view's size is " + std::to_string(spec.width) + "x" +
              std::to_string(spec.height) + "; each side must be 1 to " + std::to_string(kMaxSide));
}

Result<> check_angle(const char* name, double value, double limit, bool limit_allowed) {
  if (value > 0 && (value < limit || (limit_allowed && value == limit))) return {};
  return fail(std::string("the view's ") + name + " is " + std::to_string(value) +
              " degrees; it must be above 0 and " + (limit_allowed ? "at most " : "below ") +
              std::to_string(static_cast<int>(limit)));
}

}  // namespace

Result<ViewProjection> ViewProjection::make(const ViewSpec& spec) {
  if (auto size = check_size(spec); !size) return tl::unexpected(size.error());
  const YawPitchRoll& angles = spec.orientation;
  if (!std::isfinite(angles.yaw + angles.pitch + angles.roll)) {
    return fail("the view's yaw, pitch and roll must be finite numbers");
  }
  const bool perspective = spec.kind == ViewKind::Perspective;
  const double h_fov = spec.h_fov.value_or(perspective ? 90 : 360);
  if (auto ok = check_angle("h_fov", h_fov, perspective ? 180 : 360, !perspective); !ok) {
    return tl::unexpected(ok.error());
  }
  const double square = std::tan(radians(h_fov / 2)) * spec.height / spec.width;
  const double v_fov = spec.v_fov.value_or(perspective ? 2 * degrees(std::atan(square)) : 180);
  if (auto ok = check_angle("v_fov", v_fov, 180, !perspective); !ok) {
    return tl::unexpected(ok.error());
  }
  return ViewProjection(spec, h_fov, v_fov);
}

ViewProjection::ViewProjection(const ViewSpec& spec, double h_fov, double v_fov)
    : kind_(spec.kind),
      width_(spec.width),
      height_(spec.height),
      orientation_(rotation(spec.orientation)) {
  if (kind_ == ViewKind::Perspective) {
    step_u_ = 2 * std::tan(radians(h_fov / 2)) / width_;
    step_v_ = 2 * std::tan(radians(v_fov / 2)) / height_;
  } else {
    step_u_ = radians(h_fov) / width_;
    step_v_ = radians(v_fov) / height_;
  }
}

Vec3 ViewProjection::direction(double u, double v) const {
  const double right = (u - (width_ - 1) / 2.0) * step_u_;
  const double up = ((height_ - 1) / 2.0 - v) * step_v_;
  if (kind_ == ViewKind::Perspective) {
    return orientation_ * normalized({right, 1, up});
  }
  return orientation_ *
         Vec3{std::cos(up) * std::sin(right), std::cos(up) * std::cos(right), std::sin(up)};
}

double ViewProjection::solid_angle(double u, double v) const {
  const double right = (u - (width_ - 1) / 2.0) * step_u_;
  const double up = ((height_ - 1) / 2.0 - v) * step_v_;
  if (kind_ == ViewKind::Perspective) {
    return step_u_ * step_v_ / std::pow(1 + right * right + up * up, 1.5);
  }
  return step_u_ * 2 * std::sin(step_v_ / 2) * std::max(0.0, std::cos(up));
}

}  // namespace orbwatch::optics
