#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hal/frame_pool.h"
#include "hal/jpeg/jpeg_decoder.h"
#include "hal/v4l2/v4l2_format.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Makes frames of what a driver delivers compressed, packed or as a mosaic, in buffers of its own
/// that are made beforehand. Thread-bound.
class FrameDecoder {
 public:
  /// For a format that is not handed on as it is. Keeps OpenCV from making threads of its own, in
  /// the whole process: each camera has one.
  explicit FrameDecoder(const V4l2Agreement& agreement);

  /// The device was opened anew and agreed to the same pictures, but may lay them out differently.
  void follow(const V4l2Agreement& agreement) { agreement_ = agreement; }

  /// The frame in `samples`, which has at least what the layout needs; nullptr when frames in use
  /// hold all buffers. Errors: a damaged JPEG picture, or one of another size.
  Result<std::shared_ptr<FrameBuffer>> decode(std::span<const std::byte> samples);

 private:
  Result<> decode_into(const MutablePicture& target, std::span<const std::byte> samples);
  Result<> decode_jpeg(const MutablePicture& target, std::span<const std::byte> samples);
  Result<> decode_mosaic(const MutablePicture& target, const std::byte* rows);
  void unpack(const MutablePicture& target, const std::byte* rows);

  V4l2Agreement agreement_;
  FramePool pool_;
  JpegDecoder jpeg_;
  std::vector<std::uint8_t> mosaic_;  ///< in 8 bit
};

}  // namespace orbwatch::hal
