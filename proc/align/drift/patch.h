// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "proc/optics/vec.h"

namespace orbwatch::align {

/// Smoothed brightness of a camera's picture around a patch, row by row.
struct PatchWindow {
  /// Largest distance that a patch may have moved from the middle, px.
  static constexpr int kReach = 4;
  static constexpr int kSide = 16 + 2 * kReach + 1;

  std::array<float, kSide * kSide> values{};
  bool is_saturated = false;  ///< true if more than a tenth of it is

  const float* row(int v) const { return values.data() + v * kSide; }
};

/// The measured shift of a patch.
struct PatchShift {
  optics::Vec2 shift;  ///< px
  /// Inverse covariance of the shift from the patch's own residual, 1/px^2; small along an edge.
  cv::Matx22d information;
};

/// A piece of a reference picture that is found again to a fraction of a pixel, also when the
/// strength and offset of its light have changed: inverse-compositional Lucas-Kanade (Baker and
/// Matthews, 2004) with gain and offset as unknowns. Reentrant, immutable.
class Patch {
 public:
  static constexpr int kSide = 16;
  static constexpr int kPixels = kSide * kSide;
  using Mask = std::array<float, kPixels>;  ///< weights 0 or 1

  /// Makes a patch from a smoothed picture (32F); `corner` with a pixel around it inside. nullopt
  /// without texture: noise of the standard deviation `noise` at every pixel would leave the shift
  /// unknown.
  static std::optional<Patch> make(const cv::Mat& picture, cv::Point corner, const Mask& mask,
                                   double noise);

  /// Its shift in a window whose middle is its reference place, from a first guess. nullopt when
  /// the window shows something else or the shift is too large. Costs about 2 us.
  std::optional<PatchShift> find(const PatchWindow& window, const optics::Vec2& start) const;

  /// Standard deviation of its brightness.
  double contrast() const { return contrast_; }

 private:
  /// Slope along u, slope along v, brightness, 1.
  static constexpr int kBases = 4;

  Patch() = default;

  std::optional<double> residual_variance(const std::array<float, kPixels>& seen,
                                          const cv::Vec4d& right, const cv::Vec4d& found) const;

  std::array<std::array<float, kPixels>, kBases> bases_{};  ///< 0 outside of the mask
  cv::Matx44d inverse_;  ///< inverse of the normal matrix, held along edges
  cv::Matx22d slopes_;   ///< information on the shift alone in the normal matrix
  std::array<float, kPixels> mask_{};
  double pixels_ = 0;
  double contrast_ = 0;
};

}  // namespace orbwatch::align
