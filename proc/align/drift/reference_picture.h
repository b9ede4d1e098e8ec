// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string_view>
#include <vector>

#include "proc/image/picture.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// The median of some pictures, which removes flying sparks. Not reentrant.
class ReferencePicture {
 public:
  static constexpr std::size_t kPictures = 5;

  /// Keeps smoothed copies at that scale, see smoothed_luminance().
  explicit ReferencePicture(int scale) : scale_(scale) {}

  void add(const Picture& picture);
  bool is_complete() const { return pictures_.size() == kPictures; }

  /// Smoothed, 32F, at the scale; needs at least one picture added.
  cv::Mat median() const;

 private:
  int scale_;
  std::vector<cv::Mat> pictures_;
};

/// True if a picture of that mean brightness is too dark; never for Y16, which may be temperatures.
/// Reentrant.
bool is_too_dark(double brightness, PixelFormat format);

/// Reason why the ball in a picture cannot be a reference whatever its texture; empty if it can.
/// Only pixels within the limb count. Static text for an operator. Reentrant.
std::string_view exposure_fault(const Picture& picture, const optics::Outline& outline);

}  // namespace orbwatch::align
