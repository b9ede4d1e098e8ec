// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <optional>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/remap.h"

namespace orbwatch::fuzz {

/// The largest side of a source, px.
inline constexpr int kMaxSourceSide = 600;

/// Size of a source's pictures.
struct SourceSize {
  int width, height;
};

/// A view of a ball, and the grid compiled for it.
struct RemapScene {
  RemapScene(const optics::ViewProjection& of_view, const optics::BallProjection& of_ball,
             const SourceSize& source)
      : view(of_view), ball(of_ball), grid(view, ball, source.width, source.height) {}

  optics::ViewProjection view;
  optics::BallProjection ball;
  remap::CoordinateGrid grid;
};

/// A source, a ball, a camera, a room and a view from the bytes; nullopt if the product refuses
/// them. `even`: all sides are even, for formats that share samples between pixels.
std::optional<RemapScene> make_scene(FuzzedDataProvider& bytes, bool even);

}  // namespace orbwatch::fuzz
