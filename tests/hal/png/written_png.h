// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <png.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace orbwatch::tests {

/// A PNG picture of any layout, which OpenCV's encoder does not offer.
struct PngLayout {
  int colour_type = PNG_COLOR_TYPE_GRAY;
  int depth = 8;
  int width = 0;
  int height = 0;
  bool is_interlaced = false;
  std::string exif{};
};

/// Colours of the palette of written_png(); the first is transparent.
inline constexpr png_color kPalette[]{{250, 3, 7}, {1, 240, 9}, {4, 30, 200}, {90, 80, 70}};

inline void append(png_structp png, png_bytep data, std::size_t size) {
  const auto* const first = reinterpret_cast<const std::byte*>(data);
  auto& bytes = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
  bytes.insert(bytes.end(), first, first + size);
}

/// Encodes rows as PNG stores them: packed, 16 bit with the high byte first.
inline std::vector<std::byte> written_png(const PngLayout& layout,
                                          std::vector<std::vector<std::uint8_t>> rows) {
  std::vector<std::byte> bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(layout.width),
               static_cast<png_uint_32>(layout.height), layout.depth, layout.colour_type,
               layout.is_interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (layout.colour_type == PNG_COLOR_TYPE_PALETTE) {
    const png_byte transparency[]{0};
    png_set_PLTE(png, info, kPalette, layout.depth == 1 ? 2 : 4);
    png_set_tRNS(png, info, transparency, 1, nullptr);
  }
  if (!layout.exif.empty()) {
    std::vector<png_byte> exif(layout.exif.begin(), layout.exif.end());
    png_set_eXIf_1(png, info, static_cast<png_uint_32>(exif.size()), exif.data());
  }
  png_write_info(png, info);
  std::vector<png_bytep> pointers;
  for (auto& row : rows) pointers.push_back(row.data());
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace orbwatch::tests
