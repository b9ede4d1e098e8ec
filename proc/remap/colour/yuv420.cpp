// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/yuv420.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "proc/remap/colour/jfif_run.h"

namespace orbwatch::remap {
namespace {

std::uint8_t* row_of(const MutablePicture& out, std::size_t plane, int x, int y) {
  return reinterpret_cast<std::uint8_t*>(out.planes[plane].data) + y * out.planes[plane].stride + x;
}

ChromaRuns chroma_row(const SampledTile& tile, PixelFormat format, int y) {
  if (format == PixelFormat::I420) {
    ChromaRuns row;
    std::copy_n(&tile.planes[1][y * kTile], row.u.size(), row.u.begin());
    std::copy_n(&tile.planes[2][y * kTile], row.v.size(), row.v.begin());
    return row;
  }
  ChromaRuns row = separated(&tile.planes[1][2 * y * kTile]);
  if (format == PixelFormat::Nv21) std::swap(row.u, row.v);
  return row;
}

/// A whole run is copied by a size that the compiler knows.
void copy_chroma(const ChromaRun& from, int count, std::uint8_t* to) {
  if (count == kRun / 2) {
    std::memcpy(to, from.data(), kRun / 2);
  } else {
    std::memcpy(to, from.data(), static_cast<std::size_t>(count));
  }
}

void write_chroma_row(const ChromaRuns& row, const MutablePicture& out, const TileArea& area,
                      int y) {
  const int x = area.x / 2;
  copy_chroma(row.u, area.columns / 2, row_of(out, 1, x, area.y / 2 + y));
  copy_chroma(row.v, area.columns / 2, row_of(out, 2, x, area.y / 2 + y));
}

void write_luma_row(const std::uint8_t* rgb, int columns, std::uint8_t* to) {
  columns == kRun ? luma_run(rgb, to) : luma(rgb, to, columns);
}

}  // namespace

void write_yuv420(const ImageView<const std::uint8_t>& rgb, const MutablePicture& out,
                  const TileArea& area) {
  assert((area.x | area.y | area.columns | area.rows) % 2 == 0);
  for (int y = 0; y < area.rows; ++y) {
    write_luma_row(rgb.row(y), area.columns, row_of(out, 0, area.x, area.y + y));
  }
  for (int y = 0; y < area.rows / 2; ++y) {
    write_chroma_row(chroma_run(rgb.row(2 * y), rgb.row(2 * y + 1)), out, area, y);
  }
}

void write_yuv420(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
                  const MutablePicture& out, const TileArea& area) {
  assert((area.x | area.y | area.columns | area.rows) % 2 == 0);
  assert(is_yuv420(format, colour_space));
  write_luminance(tile, colour_space, out, area);
  for (int y = 0; y < area.rows / 2; ++y) {
    ChromaRuns row = chroma_row(tile, format, y);
    if (colour_space.range == ColourRange::Limited) {
      stretch(row.u);
      stretch(row.v);
    }
    write_chroma_row(row, out, area, y);
  }
}

}  // namespace orbwatch::remap
