// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/scene_proxy.h"
#include "proc/optics/vec.h"
#include "proc/optics/view_projection.h"
#include "proc/signals/hot_spot/hot_spot_limits.h"
#include "proc/signals/radiometry.h"
#include "proc/signals/signals.h"

namespace orbwatch::signals {

/// Settings of one region of interest: outline, thresholds and set points. Counts are those of the
/// measured plane; Radiometry::counts() converts temperatures to them.
struct RegionSettings {
  /// Corners of a spherical polygon in either sense of rotation: vectors of any length from the
  /// ball's centre, machine frame. It must fit into half of the sphere. Empty: the whole view.
  std::vector<optics::Vec3> outline;
  double hot_spot_threshold = 0;  ///< counts at which a pixel belongs to the hot spot
  HotSpotLimits hot_spot_limits{};
  std::optional<double> plume_threshold{};    ///< counts, below the hot spot's
  std::optional<double> spatter_threshold{};  ///< counts at which a pixel belongs to a spark
  std::optional<double> width_set_point{};    ///< mm
  double full_scale = 65535;                  ///< largest count of the camera
  RadiometrySettings radiometry;
};

/// The known geometry of the machine.
struct RegionScene {
  optics::Ball ball;
  optics::SceneProxy proxy;
};

/// Requirements of signals that these settings meet. `has_scene`: the proxy is not far away.
inline Requires provided_by(const RegionSettings& settings, bool has_scene) {
  using enum Requires;
  return (settings.spatter_threshold ? SpatterThreshold : Nothing) |
         (settings.plume_threshold ? PlumeThreshold : Nothing) |
         (settings.width_set_point ? WidthSetPoint : Nothing) |
         (settings.radiometry.kelvin_per_count > 0 ? RadiometricCamera : Nothing) |
         (has_scene ? Scene : Nothing);
}

/// Pixels [begin, end) of row y.
struct Span {
  int y = 0;
  int begin = 0;
  int end = 0;
};

/// The pixels of a view that lie in a region, compiled once: the frame path iterates over whole
/// rows and never uses the polygon. Immutable; reentrant.
class RegionMask {
 public:
  /// Predicate that is true for directions seen by the measured camera.
  using Sees = std::function<bool(const optics::Vec3&)>;

  /// `outline`: see RegionSettings. A pixel belongs to the region when its centre does and the
  /// camera sees it; without `sees` it sees everything. Error: an outline that is not a polygon, or
  /// without such a pixel.
  static Result<RegionMask> make(const optics::ViewProjection& view,
                                 std::span<const optics::Vec3> outline, const Sees& sees = nullptr);

  /// Sorted by row, then from left to right; pixels of the view.
  std::span<const Span> spans() const { return spans_; }

  /// Pixels of the region, and the largest possible number of separate runs of them: every second
  /// one.
  std::size_t pixels() const { return pixels_; }
  std::size_t most_runs() const { return most_runs_; }

  // The bounding box of the spans: columns [left, right), rows [top, bottom).
  int left() const { return left_; }
  int right() const { return right_; }
  int top() const { return top_; }
  int bottom() const { return bottom_; }

 private:
  std::vector<Span> spans_;
  int left_ = 0;
  int right_ = 0;
  int top_ = 0;
  int bottom_ = 0;
  std::size_t pixels_ = 0;
  std::size_t most_runs_ = 0;
};

/// The direction of a pixel's centre and its footprint. Single precision keeps 1e-7, far below a
/// pixel.
struct PixelGeometry {
  std::array<float, 3> direction{};  ///< unit vector from the ball's centre, machine frame
  float solid_angle = 0;             ///< steradian
  std::array<float, 3> position{};   ///< mm from the ball's centre; NaN if far
  float area = 0;                    ///< mm2 of the surface there; NaN if far
};

/// The geometry of the pixels in a region's bounding box, compiled once. Immutable; reentrant.
class RegionGeometry {
 public:
  RegionGeometry(const optics::ViewProjection& view, const RegionScene& scene,
                 const RegionMask& mask);

  /// Geometry of a pixel of the view, in the bounding box.
  const PixelGeometry& at(int x, int y) const { return row(y)[x - left_]; }

  /// Largest values of all pixels: steradian, and mm2 where that is known.
  double largest_solid_angle() const { return largest_solid_angle_; }
  double largest_area() const { return largest_area_; }

  /// Geometry of row y from the bounding box's first pixel on.
  const PixelGeometry* row(int y) const {
    return pixels_.data() + static_cast<std::size_t>(y - top_) * static_cast<std::size_t>(width_);
  }

 private:
  int left_;
  int top_;
  int width_;
  std::vector<PixelGeometry> pixels_;
  double largest_solid_angle_ = 0;
  double largest_area_ = 0;
};

}  // namespace orbwatch::signals
