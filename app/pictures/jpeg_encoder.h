// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "app/pictures/jpeg_quality.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Encodes JPEG by libjpeg-turbo: one-channel pictures as grey, others as Y'CbCr 4:2:0, without a
/// conversion if they already have that format (I420 in remap::kJfif). Reuses its memory for each
/// picture. Thread-bound.
class JpegEncoder {
 public:
  JpegEncoder();

  /// Returns the picture as JPEG, valid until the next call. `quality` is 1 to 100. The upper 8
  /// bits of 16 bit luminance are kept. Error: out of memory.
  Result<std::span<std::uint8_t>> encode(const Picture& picture, int quality);
  /// The same with the adapted quality of a stream, again with a lower one if it is too large.
  Result<std::span<std::uint8_t>> encode(const Picture& picture, JpegQuality& quality);

 private:
  struct Close {
    void operator()(void* encoder) const;
  };

  /// Returns the result of turbojpeg: 0, or an error.
  int compress(const Picture& picture, int quality, unsigned long& size);

  std::unique_ptr<void, Close> encoder_;
  std::vector<std::byte> converted_;
  std::vector<std::uint8_t> jpeg_;
};

}  // namespace orbwatch::app
