// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "app/pictures/picture_copy.h"
#include "hal/camera.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// Pictures that a camera delivered. Their time is on the steady clock, that of a replayed
/// recording since its first picture.
struct CameraRecord {
  hal::StreamFormat format;
  std::vector<RecordedPicture> pictures;  ///< at least one
};

/// Opens and starts all cameras, and records the first `count` pictures of each; fewer when it
/// delivers no more within `patience`. Error, by camera: it cannot be opened, or shows nothing.
std::vector<Result<CameraRecord>> record(std::span<const std::unique_ptr<hal::Camera>> cameras,
                                         std::size_t count, std::chrono::seconds patience);

}  // namespace orbwatch::app::cli
