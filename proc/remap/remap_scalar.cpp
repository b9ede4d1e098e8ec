// The specification of the kernels: one pixel at a time, no assumption about the machine.

#include <algorithm>
#include <cassert>

#include "proc/remap/remap.h"
#include "proc/remap/sampler.h"

namespace orbwatch::remap {
namespace {

template <class Sampler>
class TileWriter {
 public:
  using Sample = typename Sampler::Sample;

  TileWriter(const CoordinateGrid& grid, const Picture& source, Interpolation interpolation,
             const ImageView<Sample>& out)
      : grid_(grid),
        sampler_(source),
        nearest_(interpolation == Interpolation::Nearest),
        out_(out) {
    assert(source.width == grid.source_width() && source.height == grid.source_height());
    assert(out.width == grid.width() && out.height == grid.height());
    assert(out.channels == Sampler::kChannels);
  }

  void write(int tx, int ty) const {
    const Tile& tile = grid_.tile(tx, ty);
    switch (tile.kind) {
      case TileClass::Blind:
      case TileClass::Outside:
        return clear(tx, ty);
      case TileClass::Patch:
        return patch(tx, ty, tile.interior);
      case TileClass::Dense:
        return dense(tx, ty, tile);
    }
  }

 private:
  Sample* at(int tx, int ty, int y) const { return out_.at(tx * kTile, ty * kTile + y); }
  int columns(int tx) const { return std::min(kTile, out_.width - tx * kTile); }
  int rows(int ty) const { return std::min(kTile, out_.height - ty * kTile); }

  void clear(int tx, int ty) const {
    for (int y = 0; y < rows(ty); ++y) {
      std::fill_n(at(tx, ty, y), columns(tx) * Sampler::kChannels, Sample{0});
    }
  }

  void patch(int tx, int ty, bool interior) const {
    const Patch patch = grid_.patch(tx, ty);
    for (int y = 0; y < rows(ty); ++y) {
      PatchRow row = patch.row(y);
      Sample* out = at(tx, ty, y);
      for (int x = 0; x < columns(tx); ++x, row.step(), out += Sampler::kChannels) {
        const Coordinate c = row.current();
        sampler_.bilinear(interior && !nearest_ ? Neighbours::interior(c) : clamped(c), out);
      }
    }
  }

  void dense(int tx, int ty, const Tile& tile) const {
    for (int y = 0; y < rows(ty); ++y) {
      const CoordinateRow row = grid_.dense_row(tile, y);
      Sample* out = at(tx, ty, y);
      for (int x = 0; x < columns(tx); ++x, out += Sampler::kChannels) {
        if (is_defined(row[x])) {
          sampler_.bilinear(clamped(row[x]), out);
        } else {
          std::fill_n(out, Sampler::kChannels, Sample{0});
        }
      }
    }
  }

  Neighbours clamped(Coordinate c) const {
    if (nearest_) {
      constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
      c.u = (c.u + kHalf) & ~(2 * kHalf - 1);
      c.v = (c.v + kHalf) & ~(2 * kHalf - 1);
    }
    return Neighbours::clamped(c, grid_.source_width(), grid_.source_height());
  }

  const CoordinateGrid& grid_;
  Sampler sampler_;
  bool nearest_;
  ImageView<Sample> out_;
};

template <class Sampler>
void remap_rows(const CoordinateGrid& grid, const Picture& source, Interpolation interpolation,
                const ImageView<typename Sampler::Sample>& out, TileRows rows) {
  const TileWriter<Sampler> writer(grid, source, interpolation, out);
  for (int ty = rows.first; ty < rows.last; ++ty) {
    for (int tx = 0; tx < grid.tiles_x(); ++tx) writer.write(tx, ty);
  }
}

}  // namespace

void remap(const CoordinateGrid& grid, const Picture& source, Interpolation interpolation,
           const ImageView<std::uint8_t>& out, TileRows rows) {
  switch (source.format) {
    case PixelFormat::Grey:
      remap_rows<InterleavedSampler<std::uint8_t, 1>>(grid, source, interpolation, out, rows);
      break;
    case PixelFormat::Rgb:
      remap_rows<InterleavedSampler<std::uint8_t, 3>>(grid, source, interpolation, out, rows);
      break;
    case PixelFormat::Yuyv:
      remap_rows<YuyvSampler>(grid, source, interpolation, out, rows);
      break;
    case PixelFormat::Y16:
    case PixelFormat::Rgb16:
      assert(false && "16-bit sources are remapped to 16-bit pictures");
      break;
  }
}

void remap(const CoordinateGrid& grid, const Picture& source, Interpolation interpolation,
           const ImageView<std::uint16_t>& out, TileRows rows) {
  if (source.format == PixelFormat::Y16) {
    remap_rows<InterleavedSampler<std::uint16_t, 1>>(grid, source, interpolation, out, rows);
  } else {
    assert(source.format == PixelFormat::Rgb16);
    remap_rows<InterleavedSampler<std::uint16_t, 3>>(grid, source, interpolation, out, rows);
  }
}

}  // namespace orbwatch::remap
