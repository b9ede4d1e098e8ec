#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace orbwatch {

/// How the samples of a picture lie in memory. Multi-byte samples are in the host's byte order.
enum class PixelFormat : std::uint8_t {
  Grey,   ///< 8 bit luminance
  Y16,    ///< 16 bit, linear: intensity, or temperature counts of a radiometric camera
  Yuyv,   ///< 8 bit Y0 U Y1 V, chroma shared by two pixels of a row; width is even
  Rgb,    ///< 8 bit R G B
  Rgb16,  ///< 16 bit R G B
};

/// Fixed facts about a PixelFormat.
struct PixelFormatInfo {
  PixelFormat format;
  std::string_view name;
  int channels;          ///< samples per pixel, interleaved
  int bytes_per_sample;  ///< 1 or 2
};

inline constexpr std::array kPixelFormats{
    PixelFormatInfo{PixelFormat::Grey, "grey", 1, 1},
    PixelFormatInfo{PixelFormat::Y16, "y16", 1, 2},
    PixelFormatInfo{PixelFormat::Yuyv, "yuyv", 2, 1},
    PixelFormatInfo{PixelFormat::Rgb, "rgb", 3, 1},
    PixelFormatInfo{PixelFormat::Rgb16, "rgb16", 3, 2},
};

/// The facts about `format`; the table above stands in the order of the enum.
constexpr const PixelFormatInfo& info(PixelFormat format) {
  return kPixelFormats[static_cast<std::size_t>(format)];
}

/// Bytes of one row of `width` pixels without padding.
constexpr int row_bytes(PixelFormat format, int width) {
  return width * info(format).channels * info(format).bytes_per_sample;
}

/// From Y'CbCr to R'G'B' as a camera states it (ITU-R BT.601 or BT.709; limited 16..235 or full
/// 0..255).
enum class ColourMatrix : std::uint8_t { Bt601, Bt709 };
enum class ColourRange : std::uint8_t { Limited, Full };
struct ColourSpace {
  ColourMatrix matrix = ColourMatrix::Bt601;
  ColourRange range = ColourRange::Limited;
};

}  // namespace orbwatch
