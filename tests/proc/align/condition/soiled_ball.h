// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "proc/optics/outline.h"

namespace orbwatch::tests {

/// A ball in a random room with a process: pictures of 8 bit grey. The room is mirror_room's; the
/// process is reflected by plain vectors, dirt is painted onto the ball.
class SoiledBall {
 public:
  explicit SoiledBall(std::uint64_t seed);

  const optics::Outline& limb() const { return limb_; }
  const cv::Size& size() const { return size_; }

  /// Adds spatter and scratches until the share `share` of the ball's picture is covered.
  void soil(double share);
  /// Share of the ball's picture within 0.93 radii that is covered at half of its opacity or more.
  double soiled() const;
  /// Diameter of a circle as large as the largest spot, ball radii.
  double largest_spot() const { return largest_; }
  /// Removes that share of the contrast of all reflections.
  void fog(double share) { fog_ = share; }

  /// Moves things in the room for good: a part exchanged, a door opened, a tool parked.
  void rearrange();

  /// A picture with sparks, a tool at another place, another exposure, lamps on or off.
  cv::Mat picture();

 private:
  struct Thing {
    double longitude, latitude;  ///< radians, position of its middle
    double width, height;
    double light, stripes;
  };

  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Thing a_thing(double smallest, double largest);
  void show(const Thing& thing, cv::Mat& light) const;
  void add_spot();
  void add_scratch();
  void add_sparks(cv::Mat& light);
  void light_up(cv::Mat& light);

  std::mt19937_64 random_;
  optics::Outline limb_;
  cv::Size size_;
  cv::Mat room_;   ///< float, linear light, 1 is full scale
  cv::Mat lamps_;  ///< 8 bit mask of the room's lamps
  /// Float: directions reflected by each pixel; NaN beside the ball.
  cv::Mat longitude_, latitude_;
  cv::Mat opacity_, own_;  ///< float: opacity and brightness of the dirt
  double largest_ = 0;
  double fog_ = 0;
  std::vector<Thing> things_;
};

}  // namespace orbwatch::tests
