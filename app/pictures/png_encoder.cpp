// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/png_encoder.h"

#include <png.h>
#include <zlib.h>

#include <bit>
#include <cstddef>
#include <cstring>
#include <new>
#include <string>

#include "hal/png/png_calls.h"

namespace orbwatch::app {
namespace {

/// Wraps libpng's writer of one picture.
class PngWriter : public hal::PngCalls {
 public:
  PngWriter() = default;
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  void begin(const Picture& picture, bool has_alpha);
  void add_row(const std::uint8_t* row) { png_write_row(png_, row); }
  void end() { png_write_end(png_, info_); }

  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  static void write(png_structp png, png_bytep data, std::size_t size);
  static void flush(png_structp) {}

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::vector<std::uint8_t> bytes_;
};

/// An exception must not pass through libpng.
void PngWriter::write(png_structp png, png_bytep data, std::size_t size) {
  auto& bytes = static_cast<PngWriter*>(png_get_io_ptr(png))->bytes_;
  bool is_stored = true;
  try {
    bytes.insert(bytes.end(), data, data + size);
  } catch (const std::bad_alloc&) {
    is_stored = false;
  }
  if (!is_stored) png_error(png, "out of memory");
}

void PngWriter::begin(const Picture& picture, bool has_alpha) {
  png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, calls(), on_error, on_warning);
  if (png_ != nullptr) info_ = png_create_info_struct(png_);
  if (info_ == nullptr) leave("out of memory");
  png_set_write_fn(png_, this, write, flush);
  png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  // Neighbouring pixels differ little: with this filter runs compress nearly as well as matches.
  png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_compression_level(png_, Z_BEST_SPEED);
  png_set_compression_strategy(png_, Z_RLE);
  const PixelFormatInfo& facts = info(picture.format);
  const int colours = facts.channels() == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB;
  png_set_IHDR(png_, info_, static_cast<png_uint_32>(picture.width),
               static_cast<png_uint_32>(picture.height), 8 * facts.bytes_per_sample(),
               has_alpha ? colours | PNG_COLOR_MASK_ALPHA : colours, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png_, info_);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
  if (picture.format == PixelFormat::Bgr) png_set_bgr(png_);
}

const std::uint8_t* row_of(const Picture& picture, int y) {
  return reinterpret_cast<const std::uint8_t*>(picture.planes[0].data) +
         picture.planes[0].stride * y;
}

/// Writes the picture's row with an opaque or transparent sample after each pixel.
void add_alpha(const Picture& picture, const ImageView<const std::uint8_t>& validity, int y,
               std::uint8_t* out) {
  const auto pixel_bytes = static_cast<std::size_t>(row_bytes(picture.format, 1));
  const auto alpha_bytes = static_cast<std::size_t>(info(picture.format).bytes_per_sample());
  const std::uint8_t* pixel = row_of(picture, y);
  for (int x = 0; x < picture.width; ++x, pixel += pixel_bytes) {
    const bool is_seen = *validity.at(x, y) == static_cast<std::uint8_t>(Validity::Seen);
    std::memcpy(out, pixel, pixel_bytes);
    std::memset(out + pixel_bytes, is_seen ? 0xff : 0, alpha_bytes);
    out += pixel_bytes + alpha_bytes;
  }
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_png(const Picture& picture,
                                             const ImageView<const std::uint8_t>& validity) {
  const bool has_alpha = !validity.empty();
  std::vector<std::uint8_t> row;
  if (has_alpha) {
    row.resize(static_cast<std::size_t>(picture.width) *
               static_cast<std::size_t>(row_bytes(picture.format, 1) +
                                        info(picture.format).bytes_per_sample()));
  }
  PngWriter writer;
  const bool is_written = writer.completes([&] {
    writer.begin(picture, has_alpha);
    for (int y = 0; y < picture.height; ++y) {
      if (has_alpha) add_alpha(picture, validity, y, row.data());
      writer.add_row(has_alpha ? row.data() : row_of(picture, y));
    }
    writer.end();
  });
  if (!is_written) return fail(std::string("PNG encoder: ") + writer.message());
  return writer.take();
}

}  // namespace orbwatch::app
