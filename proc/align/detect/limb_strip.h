#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "proc/optics/outline.h"

namespace orbwatch::align {

/// The surroundings of a limb, unrolled: a row for each ray, columns along the limb's outward
/// normal from -reach to +reach pixels, kPerPixel to a pixel.
class LimbStrip {
 public:
  static constexpr int kPerPixel = 2;
  static constexpr int kTogether = 8;  ///< rays() is a multiple of it

  /// `luminance`: one channel, 8 or 16 bit; `outline` in its pixels, with axes above 0.
  LimbStrip(const cv::Mat& luminance, const optics::Outline& outline, double reach);

  int rays() const { return along_.rows; }
  int columns() const { return along_.cols; }
  int limb() const { return (columns() - 1) / 2; }  ///< the column on it
  /// Signed distance of a column from the limb, pixels.
  double distance(int column) const { return static_cast<double>(column - limb()) / kPerPixel; }
  /// Which of `count` equal parts of the ellipse's own angle a ray is in.
  std::size_t sector(int ray, std::size_t count) const {
    return static_cast<std::size_t>(ray) * count / static_cast<std::size_t>(rays());
  }

  /// A slope of brightness, per pixel.
  struct Slope {
    float along;   ///< the normal
    float across;  ///< along the limb

    float energy() const { return along * along + across * across; }
    /// Of the energy, along the normal, [0, 1].
    float share() const { return along * along / (energy() + 1e-12F); }
  };
  /// nullopt beyond the picture.
  std::optional<Slope> slope(int ray, int column) const {
    const float along = along_.at<float>(ray, column);
    if (along != along) return std::nullopt;
    return Slope{along, across_.at<float>(ray, column)};
  }

  float floor2() const { return floor2_; }  ///< the square of a slope that may be noise

 private:
  float measured_floor2() const;

  cv::Mat along_, across_;  ///< NaN beyond the picture
  float floor2_ = 0;
};

}  // namespace orbwatch::align
