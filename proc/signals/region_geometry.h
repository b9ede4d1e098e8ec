#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "proc/optics/view_projection.h"
#include "proc/signals/region.h"
#include "proc/signals/region_mask.h"

namespace orbwatch::signals {

/// The direction of a pixel's centre and its footprint. Single precision keeps 1e-7, far below a
/// pixel.
struct PixelGeometry {
  std::array<float, 3> direction{};  ///< unit vector from the ball's centre, machine frame
  float solid_angle = 0;             ///< steradian
  std::array<float, 3> position{};   ///< mm from the ball's centre; not a number if far
  float area = 0;                    ///< mm2 of the surface there; not a number if far
};

/// The geometry of the pixels in a region's bounding box, compiled once. Immutable; reentrant.
class RegionGeometry {
 public:
  RegionGeometry(const optics::ViewProjection& view, const RegionScene& scene,
                 const RegionMask& mask);

  /// Of a pixel of the view, in the bounding box.
  const PixelGeometry& at(int x, int y) const { return row(y)[x - left_]; }

  /// From the bounding box' first pixel of row y.
  const PixelGeometry* row(int y) const {
    return pixels_.data() + static_cast<std::size_t>(y - top_) * static_cast<std::size_t>(width_);
  }

 private:
  int left_;
  int top_;
  int width_;
  std::vector<PixelGeometry> pixels_;
};

}  // namespace orbwatch::signals
