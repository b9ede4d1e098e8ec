// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "proc/image/picture.h"

namespace orbwatch::app {

/// Scales display pictures down. Thread-bound; reuses its memory.
class PictureScaler {
 public:
  /// Returns `picture` with the sides `width` and `height`, none above its own, valid until the
  /// next call. Its format, kept, has 8 bits and is one of those of View::picture; the sides of
  /// I420 are even.
  Picture scaled(const Picture& picture, int width, int height);

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace orbwatch::app
