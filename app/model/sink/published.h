// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proc/image/pixel_format.h"
#include "proc/optics/lens.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// One camera of a view, and how that shows it if it has one channel.
struct PublishedSource {
  std::string camera;
  std::string colour_map;
  std::array<double, 2> range{};  ///< first and last colour, degC or % of full scale
  bool is_radiometric = false;    ///< degC
};

/// Properties of a published view.
struct PublishedView {
  PixelFormat encoding = PixelFormat::Rgb;  ///< or Bgr or Grey
  bool measured = true;                     ///< it has a plane that is measured
  optics::ViewSpec spec{};                  ///< as configured
  /// Projection of the picture of the first camera that it shows, for kind Ball; else null.
  std::shared_ptr<const optics::ViewProjection> ball = nullptr;
  bool is_own_picture = false;  ///< a display view of kind Ball, of one camera
  bool mixes = false;           ///< a display view whose sources are blended by weight
  std::vector<PublishedSource> sources{};
};

/// A camera's own picture as it is offered to the outside.
struct PublishedCamera {
  PixelFormat encoding = PixelFormat::Rgb;   ///< or Bgr or Grey
  std::optional<optics::Intrinsics> lens{};  ///< of that picture; nullopt: not calibrated
};

}  // namespace orbwatch::app
