// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/window.h"

#include <cmath>
#include <string>

namespace orbwatch::optics {

Result<> check_window(const Window& window) {
  const double length = norm(window.normal);
  if (!(length > 0) || !std::isfinite(length)) {
    return fail("the window's normal must be a direction: finite, and not 0");
  }
  if (!(window.thickness >= 0) || !std::isfinite(window.thickness)) {
    return fail("the window's thickness is " + std::to_string(window.thickness) +
                " mm; it must be at least 0");
  }
  if (!(window.index >= 1 && window.index <= 5)) {
    return fail("the window's refractive index is " + std::to_string(window.index) +
                "; it must be 1 to 5");
  }
  return {};
}

Vec3 displacement(const Window& window, const Vec3& direction) {
  // A ray along the glass never enters it; close to that, its path within grows without bound.
  constexpr double kAlong = 1e-6;
  const Vec3 normal = normalized(window.normal);
  const double towards = dot(normal, direction);
  const double cos_outside = std::abs(towards);
  if (!(cos_outside > kAlong)) return {};
  // Snell: the part along the surface shrinks by the index.
  const Vec3 along = direction - normal * towards;
  const double n = window.index;
  const double cos_inside = std::sqrt(1 - dot(along, along) / (n * n));
  return along * (window.thickness * (1 / (n * cos_inside) - 1 / cos_outside));
}

}  // namespace orbwatch::optics
