// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>

#include "proc/image/picture.h"

namespace orbwatch::app {

/// Camera's picture that owns its samples.
struct RecordedPicture {
  Picture picture;
  std::unique_ptr<std::byte[]> storage;
  std::chrono::nanoseconds time{};  ///< time of its exposure, on a clock that all cameras share
};

/// Copies every plane of `picture`, rows without padding. Reentrant.
RecordedPicture copied(const Picture& picture, std::chrono::nanoseconds time);

}  // namespace orbwatch::app
