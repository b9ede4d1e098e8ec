// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/format/frame_decoder.h"

#include <bit>
#include <cstring>

#include "hal/mosaic/demosaic.h"

namespace orbwatch::hal {
namespace {

constexpr unsigned byte(std::byte value) { return std::to_integer<unsigned>(value); }

// Layouts: V4L2's documentation of Y10P, Y12P and their Bayer variants, which are MIPI CSI-2's.

void unpack_mipi_10(const std::byte* row, int width, std::uint16_t* samples) {
  for (int x = 0; x < width; x += 4, row += 5) {
    const unsigned low = byte(row[4]);
    for (int i = 0; i < 4; ++i) {
      samples[x + i] = static_cast<std::uint16_t>(byte(row[i]) << 2 | (low >> 2 * i & 3U));
    }
  }
}

void unpack_mipi_12(const std::byte* row, int width, std::uint16_t* samples) {
  for (int x = 0; x < width; x += 2, row += 3) {
    const unsigned low = byte(row[2]);
    samples[x] = static_cast<std::uint16_t>(byte(row[0]) << 4 | (low & 15U));
    samples[x + 1] = static_cast<std::uint16_t>(byte(row[1]) << 4 | low >> 4);
  }
}

void unpack_big_endian(const std::byte* row, int width, std::uint16_t* samples) {
  for (int x = 0; x < width; ++x) {
    samples[x] = static_cast<std::uint16_t>(byte(row[2 * x]) << 8 | byte(row[2 * x + 1]));
  }
}

/// Copies the first `picked` of each group of `bytes`: the upper 8 bits of each sample.
void pick_upper(const std::byte* row, int width, int picked, int bytes, std::uint8_t* samples) {
  for (int x = 0; x < width; x += picked, row += bytes) {
    std::memcpy(samples + x, row, static_cast<std::size_t>(picked));
  }
}

void shift_to_8_bit(const std::byte* row, int width, int bits, std::uint8_t* samples) {
  for (int x = 0; x < width; ++x) {
    std::uint16_t sample;  // samples of V4L2 are little-endian
    std::memcpy(&sample, row + std::ptrdiff_t{2} * x, sizeof(sample));
    samples[x] = static_cast<std::uint8_t>(sample >> (bits - 8));
  }
}
static_assert(std::endian::native == std::endian::little);

}  // namespace

void unpack_row(Packing packing, const std::byte* row, int width, std::uint16_t* samples) {
  if (packing == Packing::Mipi10) return unpack_mipi_10(row, width, samples);
  if (packing == Packing::Mipi12) return unpack_mipi_12(row, width, samples);
  unpack_big_endian(row, width, samples);
}

void unpack_row_to_8_bit(Packing packing, int bits, const std::byte* row, int width,
                         std::uint8_t* samples) {
  if (packing == Packing::Mipi10) return pick_upper(row, width, 4, 5, samples);
  if (packing == Packing::Mipi12) return pick_upper(row, width, 2, 3, samples);
  if (packing == Packing::BigEndian) return pick_upper(row, width, 1, 2, samples);
  if (bits == 8) return pick_upper(row, width, 1, 1, samples);
  shift_to_8_bit(row, width, bits, samples);
}

FrameDecoder::FrameDecoder(const NegotiatedFormat& format, std::size_t buffers, bool keeps_jpeg)
    : format_(format),
      buffers_(buffers),
      keeps_jpeg_(keeps_jpeg && format.coding.packing == Packing::Jpeg) {
  make_pool();
  if (format.coding.mosaic == Mosaic::None || format.stream.format != PixelFormat::Bgr) return;
  mosaic_.resize(static_cast<std::size_t>(format.stream.width) *
                 static_cast<std::size_t>(format.stream.height));
}

/// Frames of the pool before stay valid.
void FrameDecoder::make_pool() {
  if (keeps_jpeg_) kept_bytes_ = format_.layout.largest;
  std::vector<std::unique_ptr<DecodedFrame>> frames;
  for (std::size_t n = 0; n < buffers_; ++n) {
    DecodedFrame& frame = *frames.emplace_back(std::make_unique<DecodedFrame>());
    const StreamFormat& stream = format_.stream;
    allocate_picture(frame, stream.format, stream.width, stream.height);
    if (keeps_jpeg_) frame.received = std::make_unique_for_overwrite<std::byte[]>(kept_bytes_);
  }
  pool_.emplace(std::move(frames));
}

void FrameDecoder::follow(const NegotiatedFormat& format) {
  format_ = format;
  if (keeps_jpeg_ && format.layout.largest > kept_bytes_) make_pool();
}

Result<> FrameDecoder::keep(DecodedFrame& frame, std::span<const std::byte> jpeg) const {
  if (jpeg.size() > kept_bytes_) {
    return fail("a frame of " + std::to_string(jpeg.size()) + " bytes; the driver announced " +
                std::to_string(kept_bytes_));
  }
  std::ranges::copy(jpeg, frame.received.get());
  frame.jpeg = {frame.received.get(), jpeg.size()};
  return {};
}

Result<std::shared_ptr<FrameBuffer>> FrameDecoder::decode(std::span<const std::byte> samples) {
  auto frame = pool_->acquire();
  if (!frame) return frame;
  frame->picture.colour_space = format_.stream.colour_space;
  const auto target =
      MutablePicture::contiguous(format_.stream.format, format_.stream.width, format_.stream.height,
                                 frame->memory, frame->picture.planes[0].stride);
  auto done = decode_into(target, samples);
  if (done && keeps_jpeg_) done = keep(*frame, samples);
  if (!done) return tl::unexpected(done.error());
  return frame;
}

Result<> FrameDecoder::decode_into(const MutablePicture& target,
                                   std::span<const std::byte> samples) {
  if (format_.coding.packing == Packing::Jpeg) return decode_jpeg(target, samples);
  const std::byte* row = samples.data() + format_.layout.planes[0].offset;
  if (target.format == PixelFormat::Bgr) return decode_mosaic(target, row);
  const auto unpacked = target.samples<std::uint16_t>();
  for (int y = 0; y < target.height; ++y, row += format_.layout.planes[0].stride) {
    unpack_row(format_.coding.packing, row, target.width, unpacked.row(y));
  }
  return {};
}

Result<> FrameDecoder::decode_jpeg(const MutablePicture& target,
                                   std::span<const std::byte> samples) {
  if (target.format == PixelFormat::Nv12) return jpeg_.decode_nv12(samples, target);
  return jpeg_.decode_packed(samples, target.samples<std::uint8_t>());
}

Result<> FrameDecoder::decode_mosaic(const MutablePicture& target, const std::byte* rows) {
  const PixelCoding& coding = format_.coding;
  const ImageView<std::uint8_t> mosaic{mosaic_.data(), target.width, target.height, 1,
                                       target.width};
  for (int y = 0; y < target.height; ++y, rows += format_.layout.planes[0].stride) {
    unpack_row_to_8_bit(coding.packing, info(coding.format).bits, rows, target.width,
                        mosaic.row(y));
  }
  return demosaic(coding.mosaic, mosaic, target.samples<std::uint8_t>());
}

}  // namespace orbwatch::hal
