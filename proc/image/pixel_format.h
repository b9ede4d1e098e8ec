// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace orbwatch {

/// Memory layout of a picture's samples, with the names of V4L2 and GenICam. Multi-byte samples are
/// in the host's byte order.
enum class PixelFormat : std::uint8_t {
  Grey,   ///< 8 bit luminance
  Y10,    ///< 10 bit luminance in the low bits of 16
  Y12,    ///< 12 bit luminance in the low bits of 16
  Y16,    ///< 16 bit, linear: intensity, or temperature counts of a radiometric camera
  Yuyv,   ///< 8 bit Y0 U Y1 V, chroma shared by two pixels of a row; width is even
  Uyvy,   ///< the same as U Y0 V Y1
  Nv12,   ///< 8 bit Y, then a plane of U V pairs, each shared by 2x2 pixels; both sides are even
  Nv21,   ///< the same with V first
  I420,   ///< 8 bit Y, then planes of U and of V, each shared by 2x2 pixels; both sides are even
  Rgb,    ///< 8 bit R G B
  Bgr,    ///< 8 bit B G R
  Bgra,   ///< 8 bit B G R and an ignored one
  Rgb16,  ///< 16 bit R G B
};

/// Colour model of a picture.
enum class ColourModel : std::uint8_t { Luminance, Yuv, Rgb };

/// One plane of a format: the samples of a pixel are adjacent; a subsampled plane has one pixel for
/// 2^shift_x columns and 2^shift_y rows of the picture.
struct PlaneInfo {
  int samples = 0;
  int shift_x = 0;
  int shift_y = 0;
};

inline constexpr std::size_t kMaxPlanes = 3;

/// The description of a PixelFormat.
struct PixelFormatInfo {
  PixelFormat format;
  std::string_view name;
  ColourModel colour;
  int bits;  ///< significant bits of a sample
  std::array<PlaneInfo, kMaxPlanes> planes;

  constexpr int bytes_per_sample() const { return bits > 8 ? 2 : 1; }
  constexpr std::size_t plane_count() const {
    std::size_t count = 0;
    while (count < kMaxPlanes && planes[count].samples > 0) ++count;
    return count;
  }
  /// Samples per pixel of the first plane.
  constexpr int channels() const { return planes[0].samples; }
};

inline constexpr std::array kPixelFormats{
    PixelFormatInfo{PixelFormat::Grey, "grey", ColourModel::Luminance, 8, {{{1}}}},
    PixelFormatInfo{PixelFormat::Y10, "y10", ColourModel::Luminance, 10, {{{1}}}},
    PixelFormatInfo{PixelFormat::Y12, "y12", ColourModel::Luminance, 12, {{{1}}}},
    PixelFormatInfo{PixelFormat::Y16, "y16", ColourModel::Luminance, 16, {{{1}}}},
    PixelFormatInfo{PixelFormat::Yuyv, "yuyv", ColourModel::Yuv, 8, {{{2}}}},
    PixelFormatInfo{PixelFormat::Uyvy, "uyvy", ColourModel::Yuv, 8, {{{2}}}},
    PixelFormatInfo{PixelFormat::Nv12, "nv12", ColourModel::Yuv, 8, {{{1}, {2, 1, 1}}}},
    PixelFormatInfo{PixelFormat::Nv21, "nv21", ColourModel::Yuv, 8, {{{1}, {2, 1, 1}}}},
    PixelFormatInfo{PixelFormat::I420, "i420", ColourModel::Yuv, 8, {{{1}, {1, 1, 1}, {1, 1, 1}}}},
    PixelFormatInfo{PixelFormat::Rgb, "rgb", ColourModel::Rgb, 8, {{{3}}}},
    PixelFormatInfo{PixelFormat::Bgr, "bgr", ColourModel::Rgb, 8, {{{3}}}},
    PixelFormatInfo{PixelFormat::Bgra, "bgra", ColourModel::Rgb, 8, {{{4}}}},
    PixelFormatInfo{PixelFormat::Rgb16, "rgb16", ColourModel::Rgb, 16, {{{3}}}},
};

/// The description of `format`; the table above is in the order of the enum.
constexpr const PixelFormatInfo& info(PixelFormat format) {
  return kPixelFormats[static_cast<std::size_t>(format)];
}

/// Bytes of one row of the first plane, `width` pixels without padding.
constexpr int row_bytes(PixelFormat format, int width) {
  return width * info(format).channels() * info(format).bytes_per_sample();
}

/// Bytes of a picture whose planes follow one another, each row padded to `stride` bytes in the
/// first plane and in proportion in the others.
constexpr std::size_t picture_bytes(PixelFormat format, std::size_t stride, int height) {
  const PixelFormatInfo& facts = info(format);
  std::size_t bytes = 0;
  for (const PlaneInfo& plane : facts.planes) {
    const auto rows = static_cast<std::size_t>(height) >> plane.shift_y;
    bytes += (stride * static_cast<std::size_t>(plane.samples) >> plane.shift_x) /
             static_cast<std::size_t>(facts.channels()) * rows;
  }
  return bytes;
}

/// Conversion from Y'CbCr to R'G'B' that a camera states (ITU-R BT.601 or BT.709; limited 16..235
/// or full 0..255).
enum class ColourMatrix : std::uint8_t { Bt601, Bt709 };
enum class ColourRange : std::uint8_t { Limited, Full };
struct ColourSpace {
  ColourMatrix matrix = ColourMatrix::Bt601;
  ColourRange range = ColourRange::Limited;
};

}  // namespace orbwatch
