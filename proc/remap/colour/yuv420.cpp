// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/yuv420.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "proc/remap/colour/jfif_run.h"

namespace orbwatch::remap {
namespace {

template <PixelFormat format>
ChromaRuns chroma_row(const SampledTile& tile, int y) {
  if constexpr (format == PixelFormat::I420) {
    ChromaRuns row;
    std::copy_n(&tile.planes[1][y * kTile], row.u.size(), row.u.begin());
    std::copy_n(&tile.planes[2][y * kTile], row.v.size(), row.v.begin());
    return row;
  } else {
    ChromaRuns row = separated(&tile.planes[1][2 * y * kTile]);
    if (format == PixelFormat::Nv21) std::swap(row.u, row.v);
    return row;
  }
}

/// Writes an area of both planes of chroma: `run(y)` makes a row of the tile. One of whole runs is
/// copied by a size that the compiler knows.
template <class Run>
[[gnu::always_inline]] inline void write_chroma(const TileArea& area, const Yuv420Planes& out,
                                                const Run& run) {
  const int rows = area.rows / 2, columns = area.columns / 2;
  const auto write = [&](int y, std::size_t count) __attribute__((always_inline)) {
    const ChromaRuns row = run(y);
    std::memcpy(out.u.row(y), row.u.data(), count);
    std::memcpy(out.v.row(y), row.v.data(), count);
  };
  if (columns == kRun / 2) {
    for (int y = 0; y < rows; ++y) write(y, kRun / 2);
  } else {
    for (int y = 0; y < rows; ++y) write(y, static_cast<std::size_t>(columns));
  }
}

/// Writes the chroma of a tile that was sampled from `format`.
template <PixelFormat format>
void write_chroma(const SampledTile& tile, ColourRange range, const TileArea& area,
                  const Yuv420Planes& out) {
  if (range == ColourRange::Full) {
    return write_chroma(area, out, [&](int y) { return chroma_row<format>(tile, y); });
  }
  write_chroma(area, out, [&](int y) {
    ChromaRuns row = chroma_row<format>(tile, y);
    stretch(row.u);
    stretch(row.v);
    return row;
  });
}

void write_luma_row(const std::uint8_t* rgb, int columns, std::uint8_t* to) {
  columns == kRun ? luma_run(rgb, to) : luma(rgb, to, columns);
}

}  // namespace

void write_yuv420(const ImageView<const std::uint8_t>& rgb, const MutablePicture& out,
                  const TileArea& area) {
  assert((area.x | area.y | area.columns | area.rows) % 2 == 0);
  const Yuv420Planes to = planes_at(out, area.x, area.y);
  for (int y = 0; y < area.rows; ++y) write_luma_row(rgb.row(y), area.columns, to.y.row(y));
  write_chroma(area, to, [&](int y) { return chroma_run(rgb.row(2 * y), rgb.row(2 * y + 1)); });
}

void write_yuv420(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
                  const MutablePicture& out, const TileArea& area) {
  assert((area.x | area.y | area.columns | area.rows) % 2 == 0);
  assert(is_yuv420(format, colour_space));
  write_luminance(tile, colour_space, out, area);
  const Yuv420Planes to = planes_at(out, area.x, area.y);
  switch (format) {
    case PixelFormat::I420:
      return write_chroma<PixelFormat::I420>(tile, colour_space.range, area, to);
    case PixelFormat::Nv21:
      return write_chroma<PixelFormat::Nv21>(tile, colour_space.range, area, to);
    default:
      return write_chroma<PixelFormat::Nv12>(tile, colour_space.range, area, to);
  }
}

void write_yuv420(const Yuv420Planes& tile, const MutablePicture& out, const TileArea& area) {
  assert((area.x | area.y | area.columns | area.rows) % 2 == 0);
  const Yuv420Planes to = planes_at(out, area.x, area.y);
  for (int y = 0; y < area.rows; ++y) std::copy_n(tile.y.row(y), area.columns, to.y.row(y));
  for (int y = 0; y < area.rows / 2; ++y) {
    std::copy_n(tile.u.row(y), area.columns / 2, to.u.row(y));
    std::copy_n(tile.v.row(y), area.columns / 2, to.v.row(y));
  }
}

}  // namespace orbwatch::remap
