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
    const int columns = std::min(kTile, out_.width - tx * kTile);
    const int rows = std::min(kTile, out_.height - ty * kTile);
    for (int y = 0; y < rows; ++y) {
      Sample* out = out_.at(tx * kTile, ty * kTile + y);
      switch (tile.kind) {
        case TileClass::Blind:
        case TileClass::Outside:
          std::fill_n(out, columns * Sampler::kChannels, Sample{0});
          break;
        case TileClass::Patch:
          patch(grid_.patch_row(tx, ty, y), tile.interior, out, columns);
          break;
        case TileClass::Dense:
          dense(grid_.dense_row(tile, y), out, columns);
          break;
      }
    }
  }

 private:
  void patch(PatchRow row, bool interior, Sample* out, int columns) const {
    for (int x = 0; x < columns; ++x, row.step(), out += Sampler::kChannels) {
      const Coordinate c = row.current();
      sample(interior && !nearest_ ? Neighbours::interior(c) : clamped(c), out);
    }
  }

  void dense(const Coordinate* row, Sample* out, int columns) const {
    for (int x = 0; x < columns; ++x, out += Sampler::kChannels) {
      if (is_defined(row[x])) {
        sample(clamped(row[x]), out);
      } else {
        std::fill_n(out, Sampler::kChannels, Sample{0});
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

  void sample(const Neighbours& neighbours, Sample* out) const {
    sampler_.bilinear(neighbours, out);
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
