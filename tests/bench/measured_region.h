// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "proc/signals/region_meter.h"

namespace orbwatch::bench {

/// Noise and process in a region of interest.
struct RegionCase {
  std::string_view name;
  int bits;         ///< per count
  double noise;     ///< share of single pixels above every threshold
  double hot_spot;  ///< share of the region that a hot spot covers
};

/// The cases of the instruction counts. A cold region is the most frequent content; noise is the
/// worst effect of a wrong exposure or a wrong threshold.
inline constexpr std::array kRegionCases{
    RegionCase{"cold_8", 8, 0, 0},        RegionCase{"cold_16", 16, 0, 0},
    RegionCase{"noisy_8", 8, 0.1, 0},     RegionCase{"noisy_16", 16, 0.1, 0},
    RegionCase{"hot_spot_8", 8, 0, 0.01}, RegionCase{"hot_spot_16", 16, 0, 0.01},
};

/// One case in a polygon of a 1280x720 view of a known surface, a corner of which no camera sees,
/// with every signal that its counts allow.
class MeasuredRegion {
 public:
  explicit MeasuredRegion(const RegionCase& wanted);

  /// Measures the next frame set. All are different.
  void run();

  /// Pixels of the region.
  std::size_t pixels() const { return pixels_; }

 private:
  void paint(std::vector<std::uint16_t>& counts, unsigned seed) const;

  RegionCase wanted_;
  optics::ViewProjection view_;
  signals::RegionMeter meter_;
  std::size_t pixels_;
  std::vector<std::uint8_t> validity_;
  /// Frame sets, used alternately.
  std::array<std::vector<std::uint8_t>, 2> bytes_;
  std::array<std::vector<std::uint16_t>, 2> words_;
  int frame_set_ = 0;
};

}  // namespace orbwatch::bench
