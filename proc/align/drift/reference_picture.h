#pragma once

#include <opencv2/core.hpp>
#include <string_view>
#include <vector>

#include "proc/image/picture.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// The median of some pictures: sparks that fly through them leave nothing. Not reentrant.
class ReferencePicture {
 public:
  static constexpr std::size_t kPictures = 5;

  /// Keeps smoothed copies at that scale, see smoothed_luminance().
  explicit ReferencePicture(int scale) : scale_(scale) {}

  void add(const Picture& picture);
  bool is_complete() const { return pictures_.size() == kPictures; }

  /// Smoothed, 32F, at the scale; at least one picture was added.
  cv::Mat median() const;

 private:
  int scale_;
  std::vector<cv::Mat> pictures_;
};

/// Why a picture cannot be a reference whatever its texture; empty if nothing speaks against it.
/// Static text for an operator. Reentrant.
std::string_view exposure_fault(const Picture& picture, const optics::Outline& outline);

}  // namespace orbwatch::align
