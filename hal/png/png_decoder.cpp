// SPDX-License-Identifier: Apache-2.0
#include "hal/png/png_decoder.h"

#include <png.h>

#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "hal/png/png_calls.h"

namespace orbwatch::hal {

/// Wraps libpng's reader of one picture.
class PngReader : public PngCalls {
 public:
  PngReader() = default;
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  auto failed(const char* what) const { return fail(std::string(what) + message()); }

  bool create();
  void read_header(std::span<const std::byte> png);
  PngHeader header() const;
  /// `bytes`: size of each row.
  void read_rows(png_bytepp rows, std::size_t bytes);
  std::span<const std::byte> exif() const;

 private:
  static void read(png_structp png, png_bytep out, std::size_t size);
  void convert_rows();

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::span<const std::byte> rest_;  ///< data that libpng has not read yet
};

void PngReader::read(png_structp png, png_bytep out, std::size_t size) {
  auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
  if (size > reader.rest_.size()) png_error(png, "ends early");
  std::memcpy(out, reader.rest_.data(), size);
  reader.rest_ = reader.rest_.subspan(size);
}

bool PngReader::create() {
  return completes([this] {
           png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, calls(), on_error, on_warning);
           if (png_ != nullptr) info_ = png_create_info_struct(png_);
         }) &&
         info_ != nullptr;
}

void PngReader::read_header(std::span<const std::byte> png) {
  rest_ = png;
  png_set_read_fn(png_, this, read);
  png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  // The caller limits the size, before libpng allocates rows.
  png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  // Texts, profiles and the like are skipped, except EXIF.
  png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_AS_DEFAULT,
                              reinterpret_cast<png_const_bytep>("eXIf"), 1);
  png_read_info(png_, info_);
}

void PngReader::convert_rows() {
  if (png_get_color_type(png_, info_) == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
  if (png_get_color_type(png_, info_) == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png_);
  png_set_strip_alpha(png_);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
  png_set_interlace_handling(png_);
  png_read_update_info(png_, info_);
}

PngHeader PngReader::header() const {
  const bool is_grey = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) == 0;
  const bool is_wide = png_get_bit_depth(png_, info_) == 16;
  PngHeader header;
  if (is_grey) {
    header.format = is_wide ? PixelFormat::Y16 : PixelFormat::Grey;
  } else {
    header.format = is_wide ? PixelFormat::Rgb16 : PixelFormat::Rgb;
  }
  header.width = static_cast<int>(png_get_image_width(png_, info_));
  header.height = static_cast<int>(png_get_image_height(png_, info_));
  return header;
}

void PngReader::read_rows(png_bytepp rows, std::size_t bytes) {
  convert_rows();
  if (png_get_rowbytes(png_, info_) != bytes) png_error(png_, "unexpected layout");
  png_read_image(png_, rows);
  png_read_end(png_, info_);
}

std::span<const std::byte> PngReader::exif() const {
  png_uint_32 size = 0;
  png_bytep data = nullptr;
  if (png_get_eXIf_1(png_, info_, &size, &data) == 0) return {};
  return std::as_bytes(std::span(data, size));
}

PngDecoder::PngDecoder() : reader_(std::make_unique<PngReader>()) {}
PngDecoder::~PngDecoder() = default;

bool is_png(std::span<const std::byte> file) {
  constexpr std::size_t kSignatureBytes = 8;
  return file.size() >= kSignatureBytes &&
         png_sig_cmp(reinterpret_cast<png_const_bytep>(file.data()), 0, kSignatureBytes) == 0;
}

Result<PngHeader> PngDecoder::open(std::span<const std::byte> png) {
  if (!reader_->create()) return fail("PNG decoder: out of memory");
  if (!reader_->completes([&] { reader_->read_header(png); })) {
    return reader_->failed("not a PNG picture: ");
  }
  return reader_->header();
}

Result<> PngDecoder::decode(const MutablePicture& target) {
  const PngHeader header = reader_->header();
  if (header.format != target.format || header.width != target.width ||
      header.height != target.height) {
    return fail("PNG decoder: the target has another format or size than the picture");
  }
  std::vector<png_bytep> rows(static_cast<std::size_t>(target.height));
  for (std::size_t y = 0; y < rows.size(); ++y) {
    rows[y] = reinterpret_cast<png_bytep>(target.planes[0].data) +
              target.planes[0].stride * static_cast<std::ptrdiff_t>(y);
  }
  const auto bytes = static_cast<std::size_t>(row_bytes(target.format, target.width));
  if (!reader_->completes([&] { reader_->read_rows(rows.data(), bytes); })) {
    return reader_->failed("damaged PNG picture: ");
  }
  return {};
}

std::span<const std::byte> PngDecoder::exif() const { return reader_->exif(); }

}  // namespace orbwatch::hal
