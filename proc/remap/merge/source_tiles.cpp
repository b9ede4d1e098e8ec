// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/source_tiles.h"

#include "proc/remap/colour/luma.h"
#include "proc/remap/colour/yuv420.h"

namespace orbwatch::remap {
namespace {

/// Writes the luma of an Rgb or Bgr source.
void write_luma(const TileRemap& tiles, int tx, int ty, const MutablePicture& out,
                const TileArea& area) {
  TilePicture<std::uint8_t, 3> tile;
  const TileArea whole{0, 0, area.columns, area.rows};
  tiles.write(tx, ty, picture_of(PixelFormat::Rgb, tile.view()), whole);
  const auto grey = part(out.samples<std::uint8_t>(), area);
  for (int y = 0; y < grey.height; ++y) luma(tile.view().row(y), grey.row(y), grey.width);
}

}  // namespace

SourceTiles::SourceTiles(const MergedSource& source, PixelFormat view, Interpolation interpolation,
                         const Kernel& kernel)
    : source_(source),
      kernel_(kernel),
      format_(source.pictures.front().format),
      order_(view == PixelFormat::Bgr ? PixelFormat::Bgr : PixelFormat::Rgb),
      colour_(info(format_).colour),
      is_wide_(info(format_).bytes_per_sample() == 2),
      is_mapped_(colour_ == ColourModel::Luminance && source.colours != nullptr),
      is_dimmed_(colour_ == ColourModel::Rgb && view == PixelFormat::Grey),
      writes_yuv420_(view == PixelFormat::I420 &&
                     (is_mapped_ || (source.match == nullptr &&
                                     is_yuv420(format_, source.pictures.front().colour_space)))),
      tiles_(*source.grid, source.pictures, interpolation, kernel,
             view == PixelFormat::Grey ? luminance() : SampledPlanes::All) {
  if (writes_yuv420_ && !is_mapped_) {
    yuv420_tiles_.emplace(*source.grid, source.pictures, interpolation, kernel,
                          SampledPlanes::Yuv420);
  }
  if (!is_to_measure(source)) return;
  const auto from = source.measured_pictures.empty() ? source.pictures : source.measured_pictures;
  measured_tiles_.emplace(*source.grid, from, interpolation, kernel, luminance());
}

SampledPlanes SourceTiles::luminance() const {
  return colour_ == ColourModel::Yuv ? SampledPlanes::Luminance : SampledPlanes::All;
}

void SourceTiles::write_yuv420(int tx, int ty, const MutablePicture& out,
                               const TileArea& area) const {
  if (is_mapped_) {
    return is_wide_ ? write_mapped_yuv420<std::uint16_t>(tx, ty, out, area)
                    : write_mapped_yuv420<std::uint8_t>(tx, ty, out, area);
  }
  yuv420_tiles_->write(tx, ty, out, area);
  measure(tx, ty);
}

void SourceTiles::write(int tx, int ty, const MutablePicture& out, const TileArea& area) const {
  if (is_mapped_) {
    is_wide_ ? write_mapped<std::uint16_t>(tx, ty, out, area)
             : write_mapped<std::uint8_t>(tx, ty, out, area);
    return;
  }
  is_dimmed_ ? write_luma(tiles_, tx, ty, out, area) : tiles_.write(tx, ty, out, area);
  measure(tx, ty);
  if (!source_.match) return;
  is_wide_ ? source_.match->apply(part(out.samples<std::uint16_t>(), area), out.format)
           : source_.match->apply(part(out.samples<std::uint8_t>(), area), out.format);
}

void SourceTiles::write_planes(int tx, int ty, PlanarTile& out) const {
  if (is_mapped_) {
    return is_wide_ ? write_mapped_planes<std::uint16_t>(tx, ty, out)
                    : write_mapped_planes<std::uint8_t>(tx, ty, out);
  }
  if (source_.match != nullptr) {
    TilePicture<std::uint8_t, 3> tile;
    write(tx, ty, picture_of(order_, tile.view()), {0, 0, kTile, kTile});
    return separate(tile.samples.data(), out);
  }
  tiles_.write_planes(tx, ty, order_, out);
  measure(tx, ty);
}

void SourceTiles::measure(int tx, int ty) const {
  if (!measured_tiles_) return;
  const TileArea place = area_of(*source_.grid, tx, ty);
  colour_ == ColourModel::Rgb ? write_luma(*measured_tiles_, tx, ty, source_.measured, place)
                              : measured_tiles_->write(tx, ty, source_.measured, place);
}

/// The values of a tile that are mapped to colours: those of the measured plane, else sampled into
/// `tile`.
template <class T>
[[gnu::always_inline]] inline ImageView<T> SourceTiles::values_of(int tx, int ty,
                                                                  TilePicture<T, 1>& tile) const {
  const TileArea place = area_of(*source_.grid, tx, ty);
  if (is_measured(source_)) {
    measure(tx, ty);
    return part(source_.measured.samples<T>(), place);
  }
  const TileArea whole{0, 0, place.columns, place.rows};
  tiles_.write(tx, ty, picture_of(format_, tile.view()), whole);
  return part(tile.view(), whole);
}

template <class T>
void SourceTiles::write_mapped(int tx, int ty, const MutablePicture& out,
                               const TileArea& area) const {
  TilePicture<T, 1> tile;
  source_.colours->apply(values_of(tx, ty, tile), part(out.samples<std::uint8_t>(), area), kernel_,
                         out.format);
}

template <class T>
void SourceTiles::write_mapped_planes(int tx, int ty, PlanarTile& out) const {
  TilePicture<T, 1> tile;
  source_.colours->apply(values_of(tx, ty, tile), out, kernel_, order_);
}

template <class T>
void SourceTiles::write_mapped_yuv420(int tx, int ty, const MutablePicture& out,
                                      const TileArea& area) const {
  TilePicture<T, 1> tile;
  const ImageView<T> values = values_of(tx, ty, tile);
  if (area.columns == kTile && area.rows == kTile) {
    return source_.colours->apply(values, planes_at(out, area.x, area.y), kernel_);
  }
  Yuv420Tile whole;
  source_.colours->apply(values, whole.planes(), kernel_);
  remap::write_yuv420(whole.planes(), out, area);
}

}  // namespace orbwatch::remap
