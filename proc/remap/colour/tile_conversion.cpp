// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/tile_conversion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "proc/remap/colour/colour_conversion.h"

namespace orbwatch::remap {
namespace {

std::uint8_t* at(const MutablePicture& out, std::size_t plane, int x_bytes, int y) {
  return reinterpret_cast<std::uint8_t*>(out.planes[plane].data) + y * out.planes[plane].stride +
         x_bytes;
}

void copy(const SampledTile& tile, PixelFormat format, const MutablePicture& out,
          const TileArea& area) {
  std::size_t n = 0;
  for (const PlaneSampling& sampling : samplings(format)) {
    const int pixel = info(sampling.layout).out_bytes();
    const int columns = area.columns >> shift(sampling.x), rows = area.rows >> shift(sampling.y);
    const int x = area.x >> shift(sampling.x), y = area.y >> shift(sampling.y);
    for (int row = 0; row < rows; ++row) {
      std::memcpy(at(out, sampling.plane, x * pixel, y + row),
                  &tile.planes[n][row * SampledTile::stride(sampling)], columns * pixel);
    }
    ++n;
  }
}

/// Writes an area of a plane of `bytes` bytes per pixel: `convert(y, to)` makes a whole row of the
/// tile. A tile that the view's border cuts is converted first and the part in the view copied
/// afterwards.
template <int bytes, class Convert>
[[gnu::always_inline]] inline void write_rows(const MutablePicture& out, const TileArea& area,
                                              const Convert& convert) {
  const int rows = area.rows;
  const bool is_cut = area.columns < kTile;
  std::uint8_t* const target = at(out, 0, bytes * area.x, area.y);
  const std::ptrdiff_t target_stride = out.planes[0].stride;
  std::array<std::uint8_t, kTile * kTile * bytes> whole;
  std::uint8_t* const first = is_cut ? whole.data() : target;
  const std::ptrdiff_t stride = is_cut ? kTile * bytes : target_stride;
  for (int y = 0; y < rows; ++y) convert(y, first + y * stride);
  if (!is_cut) return;
  for (int y = 0; y < rows; ++y) {
    std::memcpy(target + y * target_stride, &whole[y * stride], bytes * area.columns);
  }
}

template <class Run>
Run run_at(const SampledTile& tile, std::size_t plane, std::ptrdiff_t offset) {
  Run run;
  std::memcpy(run.data(), &tile.planes[plane][offset], sizeof run);
  return run;
}

/// Interleaves the samples of two runs.
void write_pairs(const SampleRun& first, const SampleRun& second, std::uint8_t* to) {
  for (std::size_t x = 0; x < kRun; ++x) {
    to[2 * x] = first[x];
    to[2 * x + 1] = second[x];
  }
}

/// Interleaves the samples of three runs.
void write_threes(const SampleRun& first, const SampleRun& second, const SampleRun& third,
                  std::uint8_t* to) {
  for (std::size_t x = 0; x < kRun; ++x) {
    to[3 * x] = first[x];
    to[3 * x + 1] = second[x];
    to[3 * x + 2] = third[x];
  }
}

/// Interleaves luminance and chroma of Yuyv and Uyvy.
template <bool luminance_first>
void interleave(const SampledTile& tile, const MutablePicture& out, const TileArea& area) {
  write_rows<2>(out, area, [&](int y, std::uint8_t* to) {
    const auto luminance = run_at<SampleRun>(tile, 0, y * kTile);
    const auto chroma = run_at<SampleRun>(tile, 1, 2 * y * kTile);
    luminance_first ? write_pairs(luminance, chroma, to) : write_pairs(chroma, luminance, to);
  });
}

/// The pairs (U, V) that the pixels of row `y` share.
template <PixelFormat format>
SampleRun chroma_of_row(const SampledTile& tile, int y) {
  const int row = y >> shift(samplings(format).items[1].y);
  if constexpr (format == PixelFormat::I420) {
    const auto u = run_at<SampleRun>(tile, 1, row * kTile);
    const auto v = run_at<SampleRun>(tile, 2, row * kTile);
    std::array<std::uint8_t, 2 * kRun> pairs;
    write_pairs(u, v, pairs.data());
    SampleRun chroma;
    std::copy_n(pairs.begin(), kRun, chroma.begin());
    return chroma;
  } else {
    auto chroma = run_at<std::array<std::uint16_t, kRun / 2>>(tile, 1, 2 * row * kTile);
    if constexpr (format == PixelFormat::Nv21) {
      for (std::uint16_t& pair : chroma) pair = std::rotl(pair, 8);
    }
    return std::bit_cast<SampleRun>(chroma);
  }
}

/// Tables are computed beforehand: a frame has thousands of tiles.
const YuvToRgb& conversion_from(ColourSpace colour_space) {
  using enum ColourMatrix;
  using enum ColourRange;
  static constexpr std::array kConversions{YuvToRgb({Bt601, Limited}), YuvToRgb({Bt601, Full}),
                                           YuvToRgb({Bt709, Limited}), YuvToRgb({Bt709, Full})};
  return kConversions[2 * (colour_space.matrix == Bt709) + (colour_space.range == Full)];
}

/// Converts a whole tile with a kernel that is faster.
template <PixelFormat format>
[[gnu::noinline]] void convert_whole(const SampledTile& tile, ColourSpace colour_space,
                                     const MutablePicture& out, const TileArea& area,
                                     const Kernel& kernel) {
  constexpr int kRowsOfChroma = 1 << shift(samplings(format).items[1].y);
  YuvRows rows{tile.planes[0].data(), tile.planes[1].data(), 2 * kTile, kRowsOfChroma,
               out.format == PixelFormat::Bgr};
  std::array<SampleRun, kTile> pairs;
  if constexpr (format == PixelFormat::I420 || format == PixelFormat::Nv21) {
    for (int y = 0; y < kTile; y += kRowsOfChroma) {
      pairs[y / kRowsOfChroma] = chroma_of_row<format>(tile, y);
    }
    rows.chroma = pairs[0].data();
    rows.chroma_stride = kRun;
  }
  kernel.write_rgb(rows, conversion_from(colour_space).coefficients(),
                   at(out, 0, 3 * area.x, area.y), out.planes[0].stride);
}

template <PixelFormat format, bool blue_first>
void yuv_to_rgb(const SampledTile& tile, ColourSpace colour_space, const MutablePicture& out,
                const TileArea& area, const Kernel& kernel) {
  constexpr int kRowsOfChroma = 1 << shift(samplings(format).items[1].y);
  if (kKernelsConvert && kernel.write_rgb && area.columns == kTile && area.rows == kTile) {
    return convert_whole<format>(tile, colour_space, out, area, kernel);
  }
  const YuvToRgb convert = conversion_from(colour_space);
  SharedColour shared{};
  write_rows<3>(out, area, [&](int y, std::uint8_t* to) {
    if (y % kRowsOfChroma == 0) shared = convert.shared(chroma_of_row<format>(tile, y));
    const RgbRun rgb = convert(run_at<SampleRun>(tile, 0, y * kTile), shared);
    blue_first ? write_threes(rgb.blue, rgb.green, rgb.red, to)
               : write_threes(rgb.red, rgb.green, rgb.blue, to);
  });
}

template <PixelFormat format>
void yuv_to_rgb(const SampledTile& tile, ColourSpace colour_space, const MutablePicture& out,
                const TileArea& area, const Kernel& kernel) {
  out.format == PixelFormat::Bgr ? yuv_to_rgb<format, true>(tile, colour_space, out, area, kernel)
                                 : yuv_to_rgb<format, false>(tile, colour_space, out, area, kernel);
}

void store(const SampleRun& run, std::uint8_t* to) { std::memcpy(to, run.data(), sizeof run); }

/// Converts a whole tile to planes; those of red and blue have the numbers `red` and `blue`.
template <PixelFormat format>
void yuv_to_planes(const SampledTile& tile, ColourSpace colour_space, std::size_t red,
                   std::size_t blue, PlanarTile& out) {
  constexpr int kRowsOfChroma = 1 << shift(samplings(format).items[1].y);
  const YuvToRgb convert = conversion_from(colour_space);
  for (int y = 0; y < kTile; y += kRowsOfChroma) {
    const SharedColour shared = convert.shared(chroma_of_row<format>(tile, y));
    for (int row = y; row < y + kRowsOfChroma; ++row) {
      const RgbRun rgb = convert(run_at<SampleRun>(tile, 0, row * kTile), shared);
      store(rgb.red, out.row(red, row));
      store(rgb.green, out.row(1, row));
      store(rgb.blue, out.row(blue, row));
    }
  }
}

/// Separates a whole tile of pixels of `bytes` bytes, of which the first three are channels.
template <int bytes>
void separate(const std::uint8_t* pixels, std::size_t first, std::size_t third, PlanarTile& out) {
  for (int y = 0; y < kTile; ++y, pixels += kRun * bytes) {
    std::array<SampleRun, 3> channels;
    for (std::size_t x = 0; x < kRun; ++x) {
      channels[0][x] = pixels[bytes * x];
      channels[1][x] = pixels[bytes * x + 1];
      channels[2][x] = pixels[bytes * x + 2];
    }
    store(channels[0], out.row(first, y));
    store(channels[1], out.row(1, y));
    store(channels[2], out.row(third, y));
  }
}

/// Converts Rgb to Bgr or back.
void swap_red_and_blue(const SampledTile& tile, const MutablePicture& out, const TileArea& area) {
  write_rows<3>(out, area, [&](int y, std::uint8_t* to) {
    const std::uint8_t* const from = &tile.planes[0][3 * y * kTile];
    for (std::size_t x = 0; x < kRun; ++x) {
      to[3 * x] = from[3 * x + 2];
      to[3 * x + 1] = from[3 * x + 1];
      to[3 * x + 2] = from[3 * x];
    }
  });
}

/// Converts Bgra to Rgb or Bgr.
template <bool blue_first>
void leave_alpha_out(const SampledTile& tile, const MutablePicture& out, const TileArea& area) {
  write_rows<3>(out, area, [&](int y, std::uint8_t* to) {
    const auto pixels = run_at<std::array<std::uint32_t, kRun>>(tile, 0, 4 * y * kTile);
    const auto sample = [&](int k) {
      SampleRun run;
      for (std::size_t x = 0; x < kRun; ++x) run[x] = static_cast<std::uint8_t>(pixels[x] >> 8 * k);
      return run;
    };
    blue_first ? write_threes(sample(0), sample(1), sample(2), to)
               : write_threes(sample(2), sample(1), sample(0), to);
  });
}

/// Converts to Rgb or Bgr.
void convert(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
             const MutablePicture& out, const TileArea& area, const Kernel& kernel) {
  switch (format) {
    case PixelFormat::Yuyv:
    case PixelFormat::Uyvy:
      return yuv_to_rgb<PixelFormat::Yuyv>(tile, colour_space, out, area, kernel);
    case PixelFormat::Nv12:
      return yuv_to_rgb<PixelFormat::Nv12>(tile, colour_space, out, area, kernel);
    case PixelFormat::Nv21:
      return yuv_to_rgb<PixelFormat::Nv21>(tile, colour_space, out, area, kernel);
    case PixelFormat::I420:
      return yuv_to_rgb<PixelFormat::I420>(tile, colour_space, out, area, kernel);
    case PixelFormat::Bgra:
      return out.format == PixelFormat::Bgr ? leave_alpha_out<true>(tile, out, area)
                                            : leave_alpha_out<false>(tile, out, area);
    default:  // one of Rgb and Bgr to the other
      return swap_red_and_blue(tile, out, area);
  }
}

}  // namespace

void write_tile(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
                const MutablePicture& out, const TileArea& area, const Kernel& kernel) {
  if (format != out.format) return convert(tile, format, colour_space, out, area, kernel);
  switch (format) {
    case PixelFormat::Yuyv:
      return interleave<true>(tile, out, area);
    case PixelFormat::Uyvy:
      return interleave<false>(tile, out, area);
    default:
      return copy(tile, format, out, area);
  }
}

void write_planes(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
                  PixelFormat order, PlanarTile& out) {
  const std::size_t red = order == PixelFormat::Bgr ? 2 : 0, blue = 2 - red;
  switch (format) {
    case PixelFormat::Yuyv:
    case PixelFormat::Uyvy:
      return yuv_to_planes<PixelFormat::Yuyv>(tile, colour_space, red, blue, out);
    case PixelFormat::Nv12:
      return yuv_to_planes<PixelFormat::Nv12>(tile, colour_space, red, blue, out);
    case PixelFormat::Nv21:
      return yuv_to_planes<PixelFormat::Nv21>(tile, colour_space, red, blue, out);
    case PixelFormat::I420:
      return yuv_to_planes<PixelFormat::I420>(tile, colour_space, red, blue, out);
    case PixelFormat::Bgra:
      return separate<4>(tile.planes[0].data(), blue, red, out);
    case PixelFormat::Bgr:
      return separate<3>(tile.planes[0].data(), blue, red, out);
    default:
      return separate<3>(tile.planes[0].data(), red, blue, out);
  }
}

void separate(const std::uint8_t* pixels, PlanarTile& out) { separate<3>(pixels, 0, 2, out); }

void write_luminance(const SampledTile& tile, ColourSpace colour_space, const MutablePicture& out,
                     const TileArea& area) {
  const YuvToRgb convert = conversion_from(colour_space);
  write_rows<1>(out, area, [&](int y, std::uint8_t* to) {
    const SampleRun luma = convert.luma(run_at<SampleRun>(tile, 0, y * kTile));
    std::memcpy(to, luma.data(), luma.size());
  });
}

void clear_area(const MutablePicture& out, const TileArea& area) {
  SampledTile tile;
  std::size_t n = 0;
  for (const PlaneSampling& sampling : samplings(out.format)) {
    std::fill_n(tile.planes[n++].begin(), kTile * SampledTile::stride(sampling),
                black(sampling, out.format, out.colour_space));
  }
  write_tile(tile, out.format, out.colour_space, out, area, scalar_kernel());
}

void clear_undefined(const CoordinateTile& coordinates, const MutablePicture& out,
                     const TileArea& area) {
  for (int y = 0; y < area.rows; ++y) {
    std::uint8_t* to = at(out, 0, 3 * area.x, area.y + y);
    for (int x = 0; x < area.columns; ++x) {
      if (!is_defined(coordinates[y][x])) std::fill_n(to + 3 * x, 3, std::uint8_t{0});
    }
  }
}

}  // namespace orbwatch::remap
