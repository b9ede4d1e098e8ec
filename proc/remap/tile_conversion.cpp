#include "proc/remap/tile_conversion.h"

#include <algorithm>
#include <cstring>

#include "proc/remap/colour_conversion.h"

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

/// Yuyv and Uyvy: luminance and chroma take turns.
void interleave(const SampledTile& tile, bool luminance_first, const MutablePicture& out,
                const TileArea& area) {
  for (int y = 0; y < area.rows; ++y) {
    const std::uint8_t* luminance = &tile.planes[0][y * kTile];
    const std::uint8_t* chroma = &tile.planes[1][2 * y * kTile];
    std::uint8_t* to = at(out, 0, 2 * area.x, area.y + y);
    for (int x = 0; x < area.columns; ++x) {
      to[2 * x + (luminance_first ? 0 : 1)] = luminance[x];
      to[2 * x + (luminance_first ? 1 : 0)] = chroma[x];
    }
  }
}

/// The chroma of a pixel of a tile.
class Chroma {
 public:
  Chroma(const SampledTile& tile, PixelFormat format)
      : planar_(format == PixelFormat::I420),
        shift_y_(shift(samplings(format).items[1].y)),
        first_(tile.planes[1].data() + (format == PixelFormat::Nv21 ? 1 : 0)),
        second_(planar_                       ? tile.planes[2].data()
                : format == PixelFormat::Nv21 ? tile.planes[1].data()
                                              : tile.planes[1].data() + 1) {}

  int u(int x, int y) const { return first_[index(x, y)]; }
  int v(int x, int y) const { return second_[index(x, y)]; }

 private:
  int index(int x, int y) const {
    const int pixel = (y >> shift_y_) * kTile + x / 2;
    return planar_ ? pixel : 2 * pixel;
  }

  bool planar_;
  int shift_y_;
  const std::uint8_t* first_;
  const std::uint8_t* second_;
};

void yuv_to_rgb(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
                const MutablePicture& out, const TileArea& area) {
  const YuvToRgb convert(colour_space);
  const Chroma chroma(tile, format);
  const bool blue_first = out.format == PixelFormat::Bgr;
  for (int y = 0; y < area.rows; ++y) {
    std::uint8_t* to = at(out, 0, 3 * area.x, area.y + y);
    for (int x = 0; x < area.columns; ++x, to += 3) {
      convert(tile.planes[0][y * kTile + x], chroma.u(x, y), chroma.v(x, y), to);
      if (blue_first) std::swap(to[0], to[2]);
    }
  }
}

/// Bgra, Bgr and Rgb to one another.
void reorder(const SampledTile& tile, PixelFormat format, const MutablePicture& out,
             const TileArea& area) {
  const int samples = info(format).channels();
  const bool swap = (format == PixelFormat::Rgb) != (out.format == PixelFormat::Rgb);
  for (int y = 0; y < area.rows; ++y) {
    const std::uint8_t* from = &tile.planes[0][y * kTile * samples];
    std::uint8_t* to = at(out, 0, 3 * area.x, area.y + y);
    for (int x = 0; x < area.columns; ++x, from += samples, to += 3) {
      to[0] = from[swap ? 2 : 0];
      to[1] = from[1];
      to[2] = from[swap ? 0 : 2];
    }
  }
}

}  // namespace

void write_tile(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
                const MutablePicture& out, const TileArea& area) {
  if (format == PixelFormat::Yuyv || format == PixelFormat::Uyvy) {
    if (format == out.format) return interleave(tile, format == PixelFormat::Yuyv, out, area);
  } else if (format == out.format) {
    return copy(tile, format, out, area);
  }
  info(format).colour == ColourModel::Yuv ? yuv_to_rgb(tile, format, colour_space, out, area)
                                          : reorder(tile, format, out, area);
}

void clear_area(const MutablePicture& out, const TileArea& area) {
  SampledTile tile;
  std::size_t n = 0;
  for (const PlaneSampling& sampling : samplings(out.format)) {
    std::fill_n(tile.planes[n++].begin(), kTile * SampledTile::stride(sampling),
                black(sampling, out.format, out.colour_space));
  }
  write_tile(tile, out.format, out.colour_space, out, area);
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
