// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "app/pipeline/views/view_plan.h"
#include "proc/image/picture.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::pipeline {

/// One camera's picture that a still view is made of.
struct StillSource {
  Picture picture;
  optics::BallProjection ball;
  double sharpness = 0;  ///< as ViewSource::sharpness
};

/// Settings of a still view.
struct StillPlan {
  optics::ViewProjection projection;
  /// The format of all sources: Grey, Y16, Rgb or Rgb16; else Rgb, of sources that all are colour
  /// and ViewRenderer::is_supported().
  PixelFormat format;
  Combine combine = Combine::Mix;
  remap::Interpolation interpolation = remap::Interpolation::Area;
  /// True: several sources of the view's format are brought to the first one's exposure.
  bool match = false;
};

/// A view that owns its pixels. Cannot be copied, since `picture` points at them.
struct StillView {
  StillView(PixelFormat format, int width, int height);
  StillView(StillView&&) = default;
  StillView(const StillView&) = delete;
  StillView& operator=(const StillView&) = delete;

  ImageView<std::uint8_t> validity_plane() {
    return {validity.data(), picture.width, picture.height, 1, picture.width};
  }

  std::vector<std::byte> pixels;
  std::vector<std::uint8_t> validity;  ///< one Validity per pixel
  MutablePicture picture;
  /// Exposure match of each source; empty: exposures were not matched.
  std::vector<remap::PhotometricMatch> matches;
};

/// Renders one view of pictures that were read or recorded, by the renderer of live views, on the
/// caller's thread. `sources`: 1..remap::kMaxSources. Reentrant; not for the frame path.
StillView render_once(const StillPlan& plan, std::span<const StillSource> sources);

}  // namespace orbwatch::app::pipeline
