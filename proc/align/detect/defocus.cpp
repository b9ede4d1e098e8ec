// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/defocus.h"

#include <algorithm>

#include "proc/align/condition/focus.h"

namespace orbwatch::align {
namespace {

/// The sigma from which on an outline is too large by more than half a pixel, px, and the share of
/// the radius that it must exceed, too. A uniform disc has a sigma of half its radius.
constexpr double kBlurredPixels = 1.4, kBlurredShare = 0.009;

}  // namespace

bool is_out_of_focus(const Picture& picture, const optics::Outline& outline) {
  const double limit = std::max(kBlurredPixels, kBlurredShare * optics::mean_radius(outline));
  const auto blur = reflection_blur(picture, outline, limit);
  return blur && blur->sigma > limit;
}

}  // namespace orbwatch::align
