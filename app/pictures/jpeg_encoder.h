#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Encodes JPEG by libjpeg-turbo: one-channel pictures as grey, others as Y'CbCr 4:2:0, without a
/// conversion if they are that (I420 in remap::kJfif). Keeps its memory from picture to picture.
/// Thread-bound.
class JpegEncoder {
 public:
  JpegEncoder();

  /// Returns the picture as JPEG, valid until the next call. `quality` is 1 to 100. Of 16 bit
  /// luminance the upper 8 bits remain. Error: out of memory.
  Result<std::span<std::uint8_t>> encode(const Picture& picture, int quality);

 private:
  struct Close {
    void operator()(void* encoder) const;
  };

  /// Returns what turbojpeg does: 0, or an error.
  int compress(const Picture& picture, int quality, unsigned long& size);

  std::unique_ptr<void, Close> encoder_;
  std::vector<std::byte> converted_;
  std::vector<std::uint8_t> jpeg_;
};

}  // namespace orbwatch::app
