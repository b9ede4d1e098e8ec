// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "app/pictures/colour_maps.h"
#include "app/pipeline/views/view_plan.h"
#include "tests/app/pipeline/hand_camera.h"

namespace orbwatch::app::pipeline {

/// View of a 16-bit HandCamera's picture, whose ball fills the frame.
inline ViewPlan thermal_view(std::size_t index, std::string name, std::size_t camera = 0) {
  const auto projection =
      optics::ViewProjection::make({optics::ViewKind::Perspective, {}, 120, {}, 96, 64}).value();
  const auto ball = optics::BallProjection::make(
                        optics::BallModel::make(optics::BallModel::Kind::Exact, 350).value(),
                        {{49.5, 49.5}, 48, 48, 0}, {})
                        .value();
  const hal::StreamFormat format{PixelFormat::Y16, {}, kHandCameraSize, kHandCameraSize, 100};
  return {index,        std::move(name),
          projection,   {{camera, format, ball, 1, {colour_map_table("hot"), 0, 65535}}},
          Combine::Mix, remap::Interpolation::Bilinear,
          std::nullopt};
}

}  // namespace orbwatch::app::pipeline
