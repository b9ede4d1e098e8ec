// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hal/frame/frame_pool.h"
#include "hal/jpeg/jpeg_decoder.h"
#include "hal/v4l2/format/pixel_coding.h"
#include "hal/v4l2/format/v4l2_format.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Unpacks a row of `width` samples into the low bits of 16. The packing is one of luminance:
/// Mipi10, Mipi12 or BigEndian. Reentrant.
void unpack_row(Packing packing, const std::byte* row, int width, std::uint16_t* samples);

/// Extracts the upper 8 bits of each sample of a row of luminance with `bits` per sample (8, 10, 12
/// or 16), in any packing but Jpeg. Reentrant.
void unpack_row_to_8_bit(Packing packing, int bits, const std::byte* row, int width,
                         std::uint8_t* samples);

/// A decoded frame.
struct DecodedFrame : FrameBuffer {
  std::unique_ptr<std::byte[]> received;  ///< memory of its JPEG data, if that is kept
};

/// Decodes a driver's compressed, packed or mosaic samples into frames of its own pool.
/// Thread-bound.
class FrameDecoder {
 public:
  /// Made for a format that is not zero-copy, with `buffers` for its frames. `keeps_jpeg`: of JPEG
  /// pictures frames keep the data, too.
  FrameDecoder(const NegotiatedFormat& format, std::size_t buffers, bool keeps_jpeg = false);

  /// Call after a reconnection with the same stream format, whose layout may differ.
  void follow(const NegotiatedFormat& format);

  /// Decodes the frame in `samples`, which has at least the layout's size; nullptr when all buffers
  /// are in use. Errors: a damaged JPEG picture, one of another size, or, where its data is kept,
  /// one of more bytes than the driver announced.
  Result<std::shared_ptr<FrameBuffer>> decode(std::span<const std::byte> samples);

  /// True for a flawed picture decoded last: see JpegDecoder::is_flawed().
  bool is_flawed() const { return jpeg_.is_flawed(); }

 private:
  void make_pool();
  Result<> keep(DecodedFrame& frame, std::span<const std::byte> jpeg) const;
  Result<> decode_into(const MutablePicture& target, std::span<const std::byte> samples);
  Result<> decode_jpeg(const MutablePicture& target, std::span<const std::byte> samples);
  Result<> decode_mosaic(const MutablePicture& target, const std::byte* rows);

  NegotiatedFormat format_;
  const std::size_t buffers_;
  const bool keeps_jpeg_;
  std::size_t kept_bytes_ = 0;  ///< most bytes of JPEG data that a frame can keep
  std::optional<BufferPool<DecodedFrame>> pool_;
  JpegDecoder jpeg_;
  std::vector<std::uint8_t> mosaic_;  ///< mosaic in 8 bit
};

}  // namespace orbwatch::hal
