#pragma once

#include <cstdint>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/optics/vec.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::signals {

/// The hottest connected place of a view.
struct HotSpot {
  bool present = false;
  optics::Vec3 direction;  ///< unit vector to its centroid, weighted by solid angle and excess
  double solid_angle = 0;  ///< steradian
  double peak = 0;         ///< counts
  double mean = 0;         ///< counts, weighted by solid angle
};

/// Finds the connected region (8 neighbours) of pixels at or above a threshold that covers the
/// largest solid angle. All memory is taken when it is made, so measuring neither allocates nor
/// needs trigonometry. Thread-bound.
class HotSpotDetector {
 public:
  explicit HotSpotDetector(const optics::ViewProjection& view);

  /// `values` and `validity` have the view's size; pixels that are not Validity::Seen do not count.
  /// `threshold` in counts.
  HotSpot measure(const ImageView<const std::uint8_t>& values,
                  const ImageView<const std::uint8_t>& validity, double threshold);
  HotSpot measure(const ImageView<const std::uint16_t>& values,
                  const ImageView<const std::uint8_t>& validity, double threshold);

 private:
  /// Unit vector and solid angle of one pixel; float keeps 1e-7, far below a pixel.
  struct PixelGeometry {
    float x, y, z, solid_angle;
  };
  /// Sums over one region, or over a part of it that is still to be joined.
  struct Region {
    optics::Vec3 moment;
    double solid_angle = 0;
    double weighted = 0;
    double peak = 0;
    std::int32_t parent = 0;
  };
  /// Pixels [begin, end) of a row that belong to a region.
  struct Run {
    int begin, end;
    std::int32_t region;
  };

  template <class T>
  HotSpot measure_any(const ImageView<const T>& values,
                      const ImageView<const std::uint8_t>& validity, double threshold);
  template <class T>
  void collect_runs(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
                    double threshold, int y);
  void join_with_row_above();
  std::int32_t root(std::int32_t region);

  int width_;
  int height_;
  std::vector<PixelGeometry> pixels_;
  std::vector<Region> regions_;
  std::vector<Run> above_;
  std::vector<Run> current_;
};

}  // namespace orbwatch::signals
