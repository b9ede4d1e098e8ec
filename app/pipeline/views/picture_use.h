// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hal/sync/frame_set.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::pipeline {

/// Limit of different strengths of sharpening per camera; each needs a copy of the sharpened plane.
inline constexpr std::size_t kMaxSharpnesses = 4;

/// Parts of one camera's picture that views sample.
class PictureUse {
 public:
  struct Sharpened {
    double sharpness = 0;
    remap::SourceArea area;  ///< its sampled part
  };

  int mip_levels = 0;

  /// Adds an area of the picture sharpened that much; 0: not sharpened. False: it would be the
  /// (kMaxSharpnesses + 1)th strength, which is left out.
  bool add(double sharpness, const remap::SourceArea& area) {
    if (sharpness == 0) return true;
    for (Sharpened& known : std::span(sharpened_.data(), count_)) {
      if (known.sharpness != sharpness) continue;
      known.area = united(known.area, area);
      return true;
    }
    if (count_ == kMaxSharpnesses) return false;
    sharpened_[count_++] = {sharpness, area};
    return true;
  }

  /// By strength.
  std::span<const Sharpened> sharpened() const { return {sharpened_.data(), count_}; }

 private:
  std::array<Sharpened, kMaxSharpnesses> sharpened_;
  std::size_t count_ = 0;
};

/// By camera.
using PictureUses = std::array<PictureUse, hal::kMaxCameras>;

}  // namespace orbwatch::app::pipeline
