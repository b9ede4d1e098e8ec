// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "app/pictures/colour_maps.h"
#include "app/pipeline/views/pan_tilt_zoom.h"
#include "tests/app/pipeline/hand_camera.h"

namespace orbwatch::app::pipeline {

// Indices of two views to point, and one that is measured.
inline constexpr std::size_t kLeft = 0, kRight = 1, kMeasured = 2;
inline constexpr std::array kNames{"left", "right", "measured"};
inline constexpr Pointing kHome{{}, 100, std::nullopt};

/// Ball that fills a HandCamera's frame.
inline optics::BallProjection ball() {
  return optics::BallProjection::make(
             optics::BallModel::make(optics::BallModel::Kind::Exact, 350).value(),
             {{49.5, 49.5}, 48, 48, 0}, {})
      .value();
}

/// Small view of a grey HandCamera's picture, as camera 0.
inline ViewPlan view_plan(std::size_t index, optics::ViewKind kind, const Pointing& pointing) {
  const auto projection = optics::ViewProjection::make(
                              {kind, pointing.orientation, pointing.h_fov, pointing.v_fov, 48, 32})
                              .value();
  const hal::StreamFormat format{PixelFormat::Grey, {}, kHandCameraSize, kHandCameraSize, 100};
  return {index,        kNames[index],
          projection,   {{0, format, ball(), 1, {colour_map_table("hot"), 0, 255}}},
          Combine::Mix, remap::Interpolation::Bilinear,
          std::nullopt};
}

}  // namespace orbwatch::app::pipeline
