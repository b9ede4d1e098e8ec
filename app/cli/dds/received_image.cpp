// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/received_image.h"

#include <algorithm>
#include <string>
#include <vector>

#include "app/pictures/picture_conversion.h"
#include "app/pictures/png_encoder.h"
#include "hal/atomic_file.h"
#include "hal/jpeg/jpeg_decoder.h"

namespace orbwatch::app::cli {
namespace {

/// Copies the rows with the two bytes of each sample exchanged; `picture` has 16 bit.
std::vector<std::byte> swapped(const Picture& picture) {
  const std::ptrdiff_t bytes = row_bytes(picture.format, picture.width);
  std::vector<std::byte> words(static_cast<std::size_t>(bytes * picture.height));
  for (int y = 0; y < picture.height; ++y) {
    const std::byte* const row = picture.planes[0].data + y * picture.planes[0].stride;
    for (std::ptrdiff_t i = 0; i < bytes; ++i) {
      words[static_cast<std::size_t>(y * bytes + i)] = row[i ^ 1];
    }
  }
  return words;
}

Result<> save(const Picture& picture, const std::filesystem::path& path) {
  const auto png = encode_png(picture);
  if (!png) return fail("image: cannot be encoded as PNG: " + png.error().message);
  return hal::write_file(path, *png);
}

}  // namespace

Result<ReceivedImage> check_image(const dds::ImageMessage& message) {
  const auto encoding = std::ranges::find(dds::kImageEncodings, std::string_view(message.encoding),
                                          &dds::ImageEncoding::name);
  // The message does not quote the sender, whose text may contain control characters.
  if (encoding == dds::kImageEncodings.end()) {
    return fail("image: encoding is none of rgb8, bgr8, mono8, mono16");
  }
  const std::uint32_t width = message.width;
  const std::uint32_t height = message.height;
  if (const auto checked = check_image_size(width, height); !checked) {
    return tl::unexpected(checked.error());
  }
  if (message.step < width * encoding->bytes_per_pixel()) {
    return fail("image: step of " + std::to_string(message.step) + " bytes, a row needs " +
                std::to_string(width * encoding->bytes_per_pixel()));
  }
  if (message.step % encoding->bytes_per_sample != 0) {
    return fail("image: step of " + std::to_string(message.step) + " bytes, samples have " +
                std::to_string(encoding->bytes_per_sample));
  }
  const std::uint64_t size = std::uint64_t{message.step} * height;
  if (message.data._length != size) {
    return fail("image: " + std::to_string(message.data._length) +
                " bytes of data, step and height say " + std::to_string(size));
  }
  return ReceivedImage{
      *encoding,
      width,
      height,
      message.step,
      message.data._buffer,
      encoding->bytes_per_sample > 1 && (message.is_bigendian != 0) != dds::kBigEndianHost};
}

Result<> check_image_size(std::uint32_t width, std::uint32_t height) {
  if (width > 0 && height > 0 && width <= kMaxImageSide && height <= kMaxImageSide) return {};
  return fail("image: " + std::to_string(width) + " x " + std::to_string(height) +
              " pixels, each side must be 1 to " + std::to_string(kMaxImageSide));
}

Result<> save_png(const ReceivedImage& image, const std::filesystem::path& path) {
  const auto width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  const PixelFormat format = image.encoding.format;
  const auto picture =
      Picture::contiguous(format, width, height, reinterpret_cast<const std::byte*>(image.data),
                          static_cast<std::ptrdiff_t>(image.step));
  if (!image.swapped) return save(picture, path);
  const std::vector<std::byte> words = swapped(picture);
  return save(Picture::contiguous(format, width, height, words.data(), row_bytes(format, width)),
              path);
}

Result<> save_jpeg_as_png(std::span<const std::uint8_t> jpeg, const std::filesystem::path& path) {
  const auto file = std::as_bytes(jpeg);
  hal::JpegDecoder decoder;
  const auto size = decoder.read_size(file);
  if (!size) return fail("image: " + size.error().message);
  const PixelFormat format = size->is_grey ? PixelFormat::Grey : PixelFormat::Rgb;
  std::vector<std::byte> pixels(packed_bytes(format, size->width, size->height));
  const auto picture = MutablePicture::contiguous(format, size->width, size->height, pixels.data(),
                                                  row_bytes(format, size->width));
  if (const auto done = decoder.decode_packed(file, picture.samples<std::uint8_t>()); !done) {
    return fail("image: " + done.error().message);
  }
  return save(picture, path);
}

}  // namespace orbwatch::app::cli
