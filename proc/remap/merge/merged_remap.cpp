#include "proc/remap/merge/merged_remap.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>

#include "proc/remap/colour/colour_conversion.h"
#include "proc/remap/sampling/tile_remap.h"

namespace orbwatch::remap {
namespace {

template <class T>
ImageView<T> part(const ImageView<T>& picture, const TileArea& area) {
  return {picture.at(area.x, area.y), area.columns, area.rows, picture.channels, picture.stride};
}

// Most tiles are whole: then the compiler knows their size.

void fill(const ImageView<std::uint8_t>& out, std::uint8_t value) {
  if (out.width == kTile && out.height == kTile) {
    std::uint8_t* row = out.data;
    for (int y = 0; y < kTile; ++y, row += out.stride) std::fill_n(row, kTile, value);
    return;
  }
  for (int y = 0; y < out.height; ++y) std::fill_n(out.row(y), out.width, value);
}

void copy(const ImageView<const std::uint8_t>& from, const ImageView<std::uint8_t>& to) {
  for (int y = 0; y < to.height; ++y) {
    to.width == kTile ? std::copy_n(from.row(y), kTile, to.row(y))
                      : std::copy_n(from.row(y), to.width, to.row(y));
  }
}

bool is_measured(const MergedSource& source) { return source.measured.planes[0].data != nullptr; }

/// A tile with memory of its own.
template <class T, int Channels>
struct TilePicture {
  alignas(64) std::array<T, kTile * kTile * Channels> samples;

  ImageView<T> view() { return {samples.data(), kTile, kTile, Channels, kTile * Channels}; }
};

/// The tiles of one source in the view's format.
class SourceTiles {
 public:
  SourceTiles(const MergedSource& source, Interpolation interpolation, const Kernel& kernel)
      : source_(source),
        format_(source.pictures.front().format),
        tiles_(*source.grid, source.pictures, interpolation, kernel) {}

  /// Whether the source may show something there, and whether it shows all of the tile.
  bool sees(int tx, int ty) const { return !is_empty(source_.grid->tile(tx, ty).kind); }
  bool fills(int tx, int ty) const {
    return is_defined_throughout(source_.grid->tile(tx, ty).kind);
  }

  /// Writes a tile into `area` of `out`, and its measured plane.
  void write(int tx, int ty, const MutablePicture& out, const TileArea& area) const {
    const ColourModel colour = info(format_).colour;
    const bool is_wide = info(format_).bytes_per_sample() == 2;
    if (colour == ColourModel::Luminance && out.format == PixelFormat::Rgb) {
      const auto rgb = part(out.samples<std::uint8_t>(), area);
      is_wide ? write_mapped<std::uint16_t>(tx, ty, rgb) : write_mapped<std::uint8_t>(tx, ty, rgb);
      return;
    }
    if (!is_measured(source_)) {
      tiles_.write(tx, ty, out, area);
    } else if (colour == ColourModel::Yuv) {
      const TileLuminance luminance{source_.measured, area_of(*source_.grid, tx, ty)};
      tiles_.write(tx, ty, out, area, &luminance);
    } else {
      tiles_.write(tx, ty, out, area);
      write_luma(tx, ty, part(out.samples<std::uint8_t>(), area));
    }
    if (!source_.match) return;
    is_wide ? source_.match->apply(part(out.samples<std::uint16_t>(), area))
            : source_.match->apply(part(out.samples<std::uint8_t>(), area));
  }

 private:
  template <class T>
  void write_mapped(int tx, int ty, const ImageView<std::uint8_t>& rgb) const {
    const TileArea place = area_of(*source_.grid, tx, ty);
    TilePicture<T, 1> tile;
    ImageView<T> values = tile.view();
    if (is_measured(source_)) {
      tiles_.write(tx, ty, source_.measured, place);
      values = part(source_.measured.samples<T>(), place);
    } else {
      tiles_.write(tx, ty, picture_of(format_, values), {0, 0, place.columns, place.rows});
      values = part(values, {0, 0, place.columns, place.rows});
    }
    source_.colours->apply(values, rgb, {0, 1});
  }

  void write_luma(int tx, int ty, const ImageView<std::uint8_t>& rgb) const {
    const TileArea place = area_of(*source_.grid, tx, ty);
    const auto out = part(source_.measured.samples<std::uint8_t>(), place);
    for (int y = 0; y < place.rows; ++y) {
      for (int x = 0; x < place.columns; ++x) *out.at(x, y) = luma(rgb.at(x, y));
    }
  }

  const MergedSource& source_;
  PixelFormat format_;
  TileRemap tiles_;
};

/// Of a view with `Channels` samples of type T per pixel.
template <class T, int Channels>
class Merger {
 public:
  Merger(std::span<const MergedSource> sources, const MergePlan& plan, const MutablePicture& out,
         const ImageView<std::uint8_t>& validity, const Kernel& kernel)
      : sources_(sources), plan_(plan), out_(out), validity_(validity) {
    assert(!sources.empty() && sources.size() <= kMaxSources);
    for (std::size_t n = 0; n < sources.size(); ++n) {
      if (!sources[n].pictures.empty()) tiles_[n].emplace(sources[n], plan.interpolation, kernel);
    }
  }

  void write(int tx, int ty) const {
    const TileArea area = area_of(*sources_.front().grid, tx, ty);
    std::array<std::size_t, kMaxSources> list;
    const Seeing seeing(list.data(), find_seeing(tx, ty, list));
    const std::size_t alone = find_alone(tx, ty, seeing);
    if (alone != kNobody) {
      tiles_[alone]->write(tx, ty, out_, area);
      fill(part(validity_, area), static_cast<std::uint8_t>(Validity::Seen));
    } else {
      copy(part(plan_.unseen, area), part(validity_, area));
      blend(tx, ty, seeing, area);
    }
    for (std::size_t n = 0; n < sources_.size(); ++n) {
      const bool written = alone == kNobody
                               ? std::find(seeing.begin(), seeing.end(), n) != seeing.end()
                               : n == alone;
      if (!written && is_measured(sources_[n])) measure_beside(n, tx, ty, area);
    }
  }

 private:
  static constexpr std::size_t kNobody = kMaxSources;
  using Seeing = std::span<const std::size_t>;

  std::size_t find_seeing(int tx, int ty, std::array<std::size_t, kMaxSources>& seeing) const {
    std::size_t count = 0;
    for (std::size_t n = 0; n < sources_.size(); ++n) {
      if (tiles_[n] && tiles_[n]->sees(tx, ty)) seeing[count++] = n;
    }
    return count;
  }

  /// The source that has all of a tile for itself, or kNobody.
  std::size_t find_alone(int tx, int ty, Seeing seeing) const {
    std::size_t alone = kNobody;
    for (const std::size_t n : seeing) {
      const bool first = plan_.rule == MergeRule::First || seeing.size() == 1;
      if (!first && !plan_.blend->counts(n, tx, ty)) continue;
      if (alone != kNobody) return kNobody;
      alone = n;
      if (first) break;
    }
    return alone != kNobody && tiles_[alone]->fills(tx, ty) ? alone : kNobody;
  }

  void blend(int tx, int ty, Seeing seeing, const TileArea& area) const {
    std::array<TilePicture<T, Channels>, kMaxSources> pictures;
    std::array<TileWeights, kMaxSources> weights;
    std::array<MergeSource<T>, kMaxSources> merged;
    for (std::size_t k = 0; k < seeing.size(); ++k) {
      const std::size_t n = seeing[k];
      tiles_[n]->write(tx, ty, picture_of(out_.format, pictures[k].view()),
                       {0, 0, area.columns, area.rows});
      plan_.blend->weights(n, *sources_[n].grid, tx, ty, weights[k]);
      merged[k] = {pictures[k].view(), {weights[k].data(), kTile, kTile, 1, kTile}};
    }
    const std::span<const MergeSource<T>> list(merged.data(), seeing.size());
    merge(plan_.rule, list, part(out_.samples<T>(), area), part(validity_, area), {0, 1});
  }

  /// The measured plane of a source that does not count in a tile.
  void measure_beside(std::size_t n, int tx, int ty, const TileArea& area) const {
    if (!tiles_[n]) return clear_area(sources_[n].measured, area);
    TilePicture<T, Channels> unused;
    tiles_[n]->write(tx, ty, picture_of(out_.format, unused.view()),
                     {0, 0, area.columns, area.rows});
  }

  std::span<const MergedSource> sources_;
  const MergePlan& plan_;
  const MutablePicture& out_;
  const ImageView<std::uint8_t>& validity_;
  std::array<std::optional<SourceTiles>, kMaxSources> tiles_;  ///< of those that delivered
};

template <class T, int Channels>
void write_rows(std::span<const MergedSource> sources, const MergePlan& plan,
                const MutablePicture& out, const ImageView<std::uint8_t>& validity, TileRows rows,
                const Kernel& kernel) {
  const Merger<T, Channels> merger(sources, plan, out, validity, kernel);
  const CoordinateGrid& grid = *sources.front().grid;
  for (int ty = rows.first; ty < rows.last; ++ty) {
    for (int tx = 0; tx < grid.tiles_x(); ++tx) merger.write(tx, ty);
  }
}

}  // namespace

void merged_remap(std::span<const MergedSource> sources, const MergePlan& plan,
                  const MutablePicture& out, const ImageView<std::uint8_t>& validity, TileRows rows,
                  const Kernel& kernel) {
  const bool is_wide = info(out.format).bytes_per_sample() == 2;
  const bool is_grey = info(out.format).channels() == 1;
  const auto write = is_wide ? is_grey ? write_rows<std::uint16_t, 1> : write_rows<std::uint16_t, 3>
                     : is_grey ? write_rows<std::uint8_t, 1>
                               : write_rows<std::uint8_t, 3>;
  write(sources, plan, out, validity, rows, kernel);
}

}  // namespace orbwatch::remap
