// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/yuv420.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "proc/remap/colour/luma.h"
#include "proc/remap/colour/run.h"

namespace orbwatch::remap {
namespace {

constexpr int kPairs = kRun / 2;
constexpr int kNeutral = 128;
using Chroma = std::array<std::uint8_t, kPairs>;

std::uint8_t* row_of(const MutablePicture& out, std::size_t plane, int x, int y) {
  return reinterpret_cast<std::uint8_t*>(out.planes[plane].data) + y * out.planes[plane].stride + x;
}

/// Four times the mean colour of each two by two pixels.
struct ColourSums {
  ColourSums(const std::uint8_t* upper, const std::uint8_t* lower) {
    std::array<std::int32_t, kRun> r, g, b;
    for (int x = 0; x < kRun; ++x) {
      r[x] = upper[3 * x] + lower[3 * x];
      g[x] = upper[3 * x + 1] + lower[3 * x + 1];
      b[x] = upper[3 * x + 2] + lower[3 * x + 2];
    }
    for (int i = 0; i < kPairs; ++i) {
      red[i] = r[2 * i] + r[2 * i + 1];
      green[i] = g[2 * i] + g[2 * i + 1];
      blue[i] = b[2 * i] + b[2 * i + 1];
    }
  }
  std::array<std::int32_t, kPairs> red, green, blue;
};

// Chroma (B - Y) / 1.772 and (R - Y) / 1.402 of JFIF, in Q16; the weights of each add up to 0.
constexpr int kBits = 16 + 2;
constexpr std::int32_t kOffset = (kNeutral << kBits) + (1 << (kBits - 1));

std::uint8_t chroma_of(std::int32_t weighted) {
  return static_cast<std::uint8_t>(std::min((weighted + kOffset) >> kBits, 255));
}
void write_chroma(const ColourSums& sums, Chroma& u, Chroma& v) {
  for (int i = 0; i < kPairs; ++i) {
    u[i] = chroma_of(-11058 * sums.red[i] - 21710 * sums.green[i] + 32768 * sums.blue[i]);
    v[i] = chroma_of(32768 * sums.red[i] - 27439 * sums.green[i] - 5329 * sums.blue[i]);
  }
}

/// Stretches a row of chroma from the limited range, whose 224 steps become 255.
void stretch(Chroma& chroma) {
  constexpr int kScaleBits = 14;
  constexpr int kScale = (255 << kScaleBits) / 224;
  for (std::uint8_t& c : chroma) {
    const int full = ((c - kNeutral) * kScale + (1 << (kScaleBits - 1))) >> kScaleBits;
    c = static_cast<std::uint8_t>(std::clamp(full + kNeutral, 0, 255));
  }
}

struct ChromaRow {
  Chroma u, v;
};

ChromaRow chroma_row(const SampledTile& tile, PixelFormat format, int y) {
  ChromaRow row;
  if (format == PixelFormat::I420) {
    std::copy_n(&tile.planes[1][y * kTile], kPairs, row.u.begin());
    std::copy_n(&tile.planes[2][y * kTile], kPairs, row.v.begin());
    return row;
  }
  const std::uint8_t* const pairs = &tile.planes[1][2 * y * kTile];
  for (int i = 0; i < kPairs; ++i) row.u[i] = pairs[2 * i];
  for (int i = 0; i < kPairs; ++i) row.v[i] = pairs[2 * i + 1];
  if (format == PixelFormat::Nv21) std::swap(row.u, row.v);
  return row;
}

void write_chroma_row(const ChromaRow& row, const MutablePicture& out, const TileArea& area,
                      int y) {
  const int x = area.x / 2;
  std::copy_n(row.u.begin(), area.columns / 2, row_of(out, 1, x, area.y / 2 + y));
  std::copy_n(row.v.begin(), area.columns / 2, row_of(out, 2, x, area.y / 2 + y));
}

}  // namespace

void write_yuv420(const ImageView<const std::uint8_t>& rgb, const MutablePicture& out,
                  const TileArea& area) {
  assert((area.x | area.y | area.columns | area.rows) % 2 == 0);
  for (int y = 0; y < area.rows; ++y)
    luma(rgb.row(y), row_of(out, 0, area.x, area.y + y), area.columns);
  for (int y = 0; y < area.rows / 2; ++y) {
    ChromaRow row;
    write_chroma(ColourSums(rgb.row(2 * y), rgb.row(2 * y + 1)), row.u, row.v);
    write_chroma_row(row, out, area, y);
  }
}

void write_yuv420(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
                  const MutablePicture& out, const TileArea& area) {
  assert((area.x | area.y | area.columns | area.rows) % 2 == 0);
  assert(is_yuv420(format, colour_space));
  write_luminance(tile, colour_space, out, area);
  for (int y = 0; y < area.rows / 2; ++y) {
    ChromaRow row = chroma_row(tile, format, y);
    if (colour_space.range == ColourRange::Limited) {
      stretch(row.u);
      stretch(row.v);
    }
    write_chroma_row(row, out, area, y);
  }
}

}  // namespace orbwatch::remap
