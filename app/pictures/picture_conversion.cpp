// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/picture_conversion.h"

#include <cstdint>
#include <cstring>

#include "proc/remap/remap.h"

namespace orbwatch::app {
namespace {

using Sample = std::uint8_t;

const Sample* row(const Picture& picture, std::size_t plane, int y) {
  return reinterpret_cast<const Sample*>(picture.planes[plane].data) +
         picture.planes[plane].stride * y;
}

const std::uint16_t* words(const Picture& picture, int y) {
  return reinterpret_cast<const std::uint16_t*>(row(picture, 0, y));
}

/// Samples of one row of a Y'CbCr picture.
struct YuvRow {
  const Sample *y, *u, *v;
  int luma_step;
  int chroma_step;  ///< step to the next pair of pixels' chroma
};

YuvRow yuv_row(const Picture& picture, int y) {
  const Sample* first = row(picture, 0, y);
  switch (picture.format) {
    case PixelFormat::Yuyv:
      return {first, first + 1, first + 3, 2, 4};
    case PixelFormat::Uyvy:
      return {first + 1, first, first + 2, 2, 4};
    case PixelFormat::Nv12:
      return {first, row(picture, 1, y / 2), row(picture, 1, y / 2) + 1, 1, 2};
    case PixelFormat::Nv21:
      return {first, row(picture, 1, y / 2) + 1, row(picture, 1, y / 2), 1, 2};
    default:
      return {first, row(picture, 1, y / 2), row(picture, 2, y / 2), 1, 1};
  }
}

/// Calls `put(x, rgb)` with each pixel of a row as R'G'B'.
template <class Put>
void each_rgb(const Picture& picture, int y, const remap::YuvToRgb& to_rgb, const Put& put) {
  const PixelFormatInfo& facts = info(picture.format);
  Sample rgb[3];
  if (facts.colour == ColourModel::Yuv) {
    const YuvRow yuv = yuv_row(picture, y);
    for (int x = 0; x < picture.width; ++x) {
      const int pair = x / 2 * yuv.chroma_step;
      to_rgb(yuv.y[x * yuv.luma_step], yuv.u[pair], yuv.v[pair], rgb);
      put(x, rgb);
    }
  } else if (picture.format == PixelFormat::Rgb16) {
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c) rgb[c] = static_cast<Sample>(words(picture, y)[3 * x + c] >> 8);
      put(x, rgb);
    }
  } else {
    const bool blue_first = picture.format != PixelFormat::Rgb;
    const int step = facts.channels();
    for (int x = 0; x < picture.width; ++x) {
      const Sample* pixel = row(picture, 0, y) + x * step;
      for (int c = 0; c < 3; ++c) rgb[c] = pixel[blue_first ? 2 - c : c];
      put(x, rgb);
    }
  }
}

/// Writes one row of luminance, 8 bit.
void grey_row(const Picture& picture, int y, const remap::YuvToRgb& to_rgb, Sample* out) {
  const PixelFormatInfo& facts = info(picture.format);
  if (picture.format == PixelFormat::Grey) {
    std::memcpy(out, row(picture, 0, y), static_cast<std::size_t>(picture.width));
  } else if (facts.colour == ColourModel::Luminance) {
    for (int x = 0; x < picture.width; ++x) {
      out[x] = static_cast<Sample>(words(picture, y)[x] >> (facts.bits - 8));
    }
  } else if (facts.colour == ColourModel::Yuv) {
    const YuvRow yuv = yuv_row(picture, y);
    for (int x = 0; x < picture.width; ++x) out[x] = yuv.y[x * yuv.luma_step];
  } else {
    each_rgb(picture, y, to_rgb, [&](int x, const Sample* rgb) { out[x] = remap::luma(rgb); });
  }
}

void colour_row(const Picture& picture, int y, const remap::YuvToRgb& to_rgb, bool blue_first,
                Sample* out) {
  if (info(picture.format).colour == ColourModel::Luminance) {
    // The grey row is in the output's last third: expanding it from the left never overwrites an
    // unread sample.
    Sample* grey = out + 2 * picture.width;
    grey_row(picture, y, to_rgb, grey);
    for (int x = 0; x < picture.width; ++x) std::memset(out + 3 * x, grey[x], 3);
    return;
  }
  each_rgb(picture, y, to_rgb, [&](int x, const Sample* rgb) {
    for (int c = 0; c < 3; ++c) out[3 * x + c] = rgb[blue_first ? 2 - c : c];
  });
}

}  // namespace

std::size_t packed_bytes(PixelFormat format, int width, int height) {
  return static_cast<std::size_t>(row_bytes(format, width)) * static_cast<std::size_t>(height);
}

bool converts(PixelFormat from, PixelFormat to) {
  switch (to) {
    case PixelFormat::Rgb:
    case PixelFormat::Bgr:
    case PixelFormat::Grey:
      return true;
    case PixelFormat::Y16:
      return info(from).colour == ColourModel::Luminance && info(from).bits > 8;
    default:
      return false;
  }
}

void convert(const Picture& picture, PixelFormat to, std::byte* out) {
  const remap::YuvToRgb to_rgb(picture.colour_space);
  const auto step = static_cast<std::size_t>(row_bytes(to, picture.width));
  auto* target = reinterpret_cast<Sample*>(out);
  const bool copied = to == picture.format || to == PixelFormat::Y16;
  for (int y = 0; y < picture.height; ++y, target += step) {
    if (copied) {
      std::memcpy(target, row(picture, 0, y), step);
    } else if (to == PixelFormat::Grey) {
      grey_row(picture, y, to_rgb, target);
    } else {
      colour_row(picture, y, to_rgb, to == PixelFormat::Bgr, target);
    }
  }
}

}  // namespace orbwatch::app
