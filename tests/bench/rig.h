// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::bench {

/// A view of the bench's fixed rig, with its name in options and reports.
struct NamedView {
  std::string_view name;
  optics::ViewKind kind;
  optics::YawPitchRoll orientation;
  int width;
  int height;
};
inline constexpr std::array kViews{
    NamedView{"flat_o0", optics::ViewKind::Perspective, {0, 0, 0}, 1920, 1080},
    NamedView{"flat_o1", optics::ViewKind::Perspective, {40, 20, 10}, 1920, 1080},
    NamedView{"flat_o2", optics::ViewKind::Perspective, {110, -30, 45}, 1920, 1080},
    NamedView{"equirect", optics::ViewKind::Equirectangular, {0, 0, 0}, 3840, 1920},
};

/// The view called `name`; nullopt when there is none.
std::optional<NamedView> find_view(std::string_view name);

/// Common input of all contestants: one view of a ball that fills a square picture of `source`
/// pixels a side, far away, by the exact model. Flat views are 90 degrees wide.
struct Rig {
  Rig(const NamedView& chosen, int source_side);

  /// Place of each pixel of the view, shrunk by `divisor` along both axes, in the source picture
  /// shrunk as much: row by row, OpenCV pixels; nullopt in the blind cone.
  std::vector<std::optional<optics::Vec2>> exact_map(int divisor = 1) const;

  NamedView named;
  int source;
  optics::ViewProjection view;
  optics::BallProjection ball;
};

}  // namespace orbwatch::bench
