// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace orbwatch::align {

/// Slopes of brightness around a round thing, unrolled: a row for each ray of a closed ring,
/// columns outwards.
class SlopeStrip {
 public:
  static constexpr int kPerUnit = 2;   ///< columns per unit
  static constexpr int kTogether = 8;  ///< rays() is a multiple of it

  int rays() const { return along_.rows; }
  int columns() const { return along_.cols; }

  /// A slope of brightness, per unit.
  struct Slope {
    float along;   ///< along the ray
    float across;  ///< from ray to ray

    float energy() const { return along * along + across * across; }
    /// Share of the energy along the ray, [0, 1].
    float share() const { return along * along / (energy() + 1e-12F); }
  };
  /// nullopt beyond the picture.
  std::optional<Slope> slope(int ray, int column) const {
    const float along = along_.at<float>(ray, column);
    if (along != along) return std::nullopt;
    return Slope{along, across_.at<float>(ray, column)};
  }

  float floor2() const { return floor2_; }  ///< the squared noise threshold of slopes

 protected:
  /// Places of the samples in the picture, by ray and column: pixels, float.
  struct Places {
    Places(int rays, int columns) : u(rays, columns, CV_32F), v(rays, columns, CV_32F) {}
    cv::Mat u, v;
  };
  /// `luminance`: one channel, 8 or 16 bit. `margin`: pixels left out at its border.
  SlopeStrip(const cv::Mat& luminance, const Places& places, double rays_per_unit, double margin);

 private:
  float measured_floor2() const;

  cv::Mat along_, across_;  ///< NaN beyond the picture
  float floor2_ = 0;
};

}  // namespace orbwatch::align
