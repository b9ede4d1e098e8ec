// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "proc/align/register/sphere_view.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// The normalised gradient field of a camera's whole surroundings (Haber and Modersitzki 2006): it
/// keeps the place and direction of edges, not their strength or sign, which is all that a colour
/// and a thermal camera have in common. Immutable; reentrant.
class GradientField {
 public:
  /// `smoothing`: sigma in pixels of the faces' middle.
  GradientField(const std::vector<SphereFace>& faces, double smoothing);

  /// The gradient along the sphere, of length 0 to 1: 1 at strong edges, about 0.7 at an average
  /// slope. nullopt where the camera shows nothing, or nothing but a limb's surroundings.
  std::optional<optics::Vec3> at(const optics::Vec3& direction) const;

  /// A place with a gradient above the threshold.
  struct Sample {
    optics::Vec3 direction;
    optics::Vec3 gradient;
    std::size_t part;  ///< part of the sphere, below kParts
  };
  /// Samples at those of `directions` directions, even over the sphere, whose gradient is above the
  /// threshold. They are not the faces' pixels: coinciding pixels of two fields would increase
  /// their likeness.
  std::vector<Sample> samples(int directions) const;

  static constexpr std::size_t kParts = 24;  ///< three for each octant

 private:
  struct Face {
    optics::ViewProjection view;
    cv::Mat gradients;  ///< 3 x float; NaN where nothing is shown
  };
  std::vector<Face> faces_;
};

}  // namespace orbwatch::align
