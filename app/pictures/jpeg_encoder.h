#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Pictures to JPEG by libjpeg-turbo: grey ones as grey, others as Y'CbCr with chroma of half the
/// resolution. Memory is kept from picture to picture. Thread-bound.
class JpegEncoder {
 public:
  JpegEncoder();

  /// The picture as JPEG, valid until the next call. `quality` is 1 to 100. 16 bit luminance keeps
  /// its upper 8. Error: out of memory.
  Result<std::span<std::uint8_t>> encode(const Picture& picture, int quality);

 private:
  struct Close {
    void operator()(void* encoder) const;
  };

  std::unique_ptr<void, Close> encoder_;
  std::vector<std::byte> converted_;
  std::vector<std::uint8_t> jpeg_;
};

}  // namespace orbwatch::app
