// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hal/frame/frame.h"

namespace orbwatch::hal {

/// Maximum number of cameras of a pipeline.
inline constexpr std::size_t kMaxCameras = 4;

/// Frames of several cameras that belong to one moment.
struct FrameSet {
  std::uint64_t id = 0;                  ///< counts sets from 1
  TimePoint stamp;                       ///< exposure start of the pacing camera's frame
  std::optional<std::uint64_t> trigger;  ///< trigger of that frame, see FrameMetadata
  /// Frame of each camera; null while the camera has a fault, has delivered nothing yet, or has no
  /// frame of this moment under SyncPolicy::Nearest.
  std::array<Frame, kMaxCameras> frames;
  std::array<bool, kMaxCameras> held{};  ///< for each camera: the frame was in an earlier set, too
  bool matched = true;  ///< every camera without a fault has a frame of this moment in the set
  Clock::duration skew{
      0};  ///< time between the first and the last exposure start of this moment's frames

  /// Time from the start of the exposure of a camera's frame to `stamp`; below 0 when it began
  /// later. The camera must have a frame in the set.
  Clock::duration age(std::size_t camera) const {
    return stamp - frames[camera]->metadata.exposure_start;
  }
};

}  // namespace orbwatch::hal
