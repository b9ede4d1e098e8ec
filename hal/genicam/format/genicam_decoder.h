// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hal/frame/frame_pool.h"
#include "hal/genicam/format/negotiation.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Decodes packed samples and mosaics into frames of its own pool, without allocation.
/// Thread-bound.
class GenicamDecoder {
 public:
  /// Made for a format that is not zero-copy, with `buffers` for its frames.
  GenicamDecoder(const GenicamStreamFormat& format, std::size_t buffers);

  /// Decodes the frame whose rows begin every `stride` bytes from `rows` on; nullptr when all
  /// buffers are in use. Error: the mosaic is too small.
  Result<std::shared_ptr<FrameBuffer>> decode(const std::byte* rows, std::size_t stride);

 private:
  GenicamStreamFormat format_;
  FramePool pool_;
  std::vector<std::uint8_t> mosaic_;  ///< mosaic in 8 bit
};

}  // namespace orbwatch::hal
