// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/merged_remap.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <optional>

#include "proc/remap/colour/planar_tile.h"
#include "proc/remap/colour/yuv420.h"
#include "proc/remap/merge/source_tiles.h"

namespace orbwatch::remap {
namespace {

// Most tiles are whole: then the compiler knows their size.

void fill(const ImageView<std::uint8_t>& out, std::uint8_t value) {
  if (out.width == kTile && out.height == kTile) {
    std::uint8_t* row = out.data;
#pragma GCC unroll 16
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

constexpr bool is_one(SourceSet sources) { return (sources & (sources - 1)) == 0 && sources != 0; }
constexpr std::size_t first_of(SourceSet sources) { return std::countr_zero(sources); }
constexpr SourceSet set_of(std::size_t n) { return static_cast<SourceSet>(1U << n); }

/// Calls `visit(n)` for each source of a set, in their order.
template <class Visit>
[[gnu::always_inline]] inline void for_each(SourceSet sources, const Visit& visit) {
  for (unsigned rest = sources; rest != 0; rest &= rest - 1) {
    visit(first_of(static_cast<SourceSet>(rest)));
  }
}

/// Merges a view with `Channels` samples of type T per pixel.
template <class T, int Channels>
class Merger {
 public:
  Merger(std::span<const MergedSource> sources, const MergePlan& plan, const MutablePicture& out,
         const ImageView<std::uint8_t>& validity, const Kernel& kernel)
      : sources_(sources), plan_(plan), kernel_(kernel), out_(out), validity_(validity) {
    assert(!sources.empty() && sources.size() <= kMaxSources);
    for (std::size_t n = 0; n < sources.size(); ++n) {
      if (SourceTiles::is_to_measure(sources[n])) measured_ |= set_of(n);
      if (sources[n].pictures.empty()) continue;
      delivering_ |= set_of(n);
      tiles_[n].emplace(sources[n], out.format, plan.interpolation, kernel);
      if (tiles_[n]->writes_yuv420()) yuv420_ |= set_of(n);
    }
  }

  void write(int tx, int ty) const {
    const TileArea area = area_of(*sources_.front().grid, tx, ty);
    if (out_.planes[0].data == nullptr) return measure(tx, ty, area);
    // The most common case, checked first.
    if (sources_.size() == 1 && delivering_ != 0 && tiles_[0]->fills(tx, ty)) {
      return write_alone(tx, ty, 0, area);
    }
    SourceSet shown = find_seeing(tx, ty);
    const SourceSet counting = find_counting(tx, ty, shown);
    if (share_all(tx, ty, counting, area)) {
      shown = counting;
      is_one(shown) ? write_alone(tx, ty, first_of(shown), area) : mix(tx, ty, shown, area);
    } else {
      copy(part(plan_.unseen, area), part(validity_, area));
      blend(tx, ty, shown, area);
    }
    for_each(measured_ & ~shown, [&](std::size_t n) { measure_beside(n, tx, ty, area); });
  }

 private:
  using Tile = TilePicture<T, Channels>;

  SourceSet find_seeing(int tx, int ty) const {
    SourceSet seeing = 0;
    for_each(delivering_, [&](std::size_t n) {
      if (tiles_[n]->sees(tx, ty)) seeing |= set_of(n);
    });
    return seeing;
  }

  /// Sources of `seeing` that the tile shows unless they leave a part of it to the others.
  SourceSet find_counting(int tx, int ty, SourceSet seeing) const {
    if (is_one(seeing)) return seeing;
    if (plan_.rule == MergeRule::First) return seeing & -seeing;
    return seeing & plan_.blend->sharing(tx, ty);
  }

  /// True if the sources cover all of the tile: one alone, or each with its share everywhere.
  bool share_all(int tx, int ty, SourceSet sources, const TileArea& area) const {
    bool all = sources != 0;
    for_each(sources, [&](std::size_t n) { all &= tiles_[n]->fills(tx, ty); });
    if (!all || is_one(sources)) return all;
    return sizeof(T) == 1 && area.columns == kTile && area.rows == kTile &&
           sources == plan_.blend->sharing(tx, ty) && plan_.blend->adds_up(tx, ty);
  }

  void write_alone(int tx, int ty, std::size_t n, const TileArea& area) const {
    if ((yuv420_ & set_of(n)) != 0) {
      tiles_[n]->write_yuv420(tx, ty, out_, area);
    } else {
      show(area, [&](const MutablePicture& out, const TileArea& place) {
        tiles_[n]->write(tx, ty, out, place);
      });
    }
    fill(part(validity_, area), static_cast<std::uint8_t>(Validity::Seen));
  }

  /// Calls `write(out, place)` with the target of a tile's pixels: the view or, for an I420 one, a
  /// tile of Rgb that is converted while it is in the cache.
  template <class Write>
  [[gnu::always_inline]] void show(const TileArea& area, const Write& write) const {
    if constexpr (sizeof(T) == 1 && Channels == 3) {
      if (out_.format == PixelFormat::I420) {
        Tile tile;
        write(picture_of(PixelFormat::Rgb, tile.view()), {0, 0, area.columns, area.rows});
        return write_yuv420(tile.view(), out_, area);
      }
    }
    write(out_, area);
  }
  PixelFormat tile_format() const {
    return out_.format == PixelFormat::I420 ? PixelFormat::Rgb : out_.format;
  }

  void write(int tx, int ty, std::size_t n, const TileArea& area, Tile& tile) const {
    tiles_[n]->write(tx, ty, picture_of(tile_format(), tile.view()),
                     {0, 0, area.columns, area.rows});
  }

  [[gnu::noinline]] void mix(int tx, int ty, SourceSet sources, const TileArea& area) const {
    if constexpr (sizeof(T) == 1 && Channels == 3) {
      if ((sources & ~yuv420_) == 0) return mix_yuv420(tx, ty, sources, area);
      if (kernel_.mix_planes != nullptr) return mix_planes(tx, ty, sources, area);
    }
    if constexpr (sizeof(T) == 1) {
      mix_tiles<Tile>(
          tx, ty, sources, area,
          [&](std::size_t n, Tile& picture) { write(tx, ty, n, area, picture); },
          [&](std::span<const MixedTile> mixed) {
            show(area, [&](const MutablePicture& out, const TileArea& place) {
              kernel_.mix(mixed, part(out.samples<T>(), place));
            });
          });
    }
  }

  /// Calls `write(n, picture)` for each source, and `mix` with all of these pictures.
  template <class Picture, class Write, class Mix>
  [[gnu::always_inline]] void mix_tiles(int tx, int ty, SourceSet sources, const TileArea& area,
                                        const Write& write, const Mix& mix) const {
    std::array<Picture, kMaxSources> pictures;
    std::array<MixedTile, kMaxSources> mixed;
    std::size_t count = 0;
    for_each(sources, [&](std::size_t n) {
      write(n, pictures[count]);
      mixed[count] = {pictures[count].samples.data(), plan_.blend->corners(n, tx, ty)};
      ++count;
    });
    mix(std::span<const MixedTile>(mixed.data(), count));
    fill(part(validity_, area), static_cast<std::uint8_t>(Validity::Seen));
  }

  [[gnu::noinline]] void mix_planes(int tx, int ty, SourceSet sources, const TileArea& area) const {
    mix_tiles<PlanarTile>(
        tx, ty, sources, area,
        [&](std::size_t n, PlanarTile& picture) { tiles_[n]->write_planes(tx, ty, picture); },
        [&](std::span<const MixedTile> mixed) {
          show(area, [&](const MutablePicture& out, const TileArea& place) {
            kernel_.mix_planes(mixed, part(out.samples<std::uint8_t>(), place));
          });
        });
  }

  /// Mixes a tile of an I420 view in its own format. Other tiles of such a view are mixed as R'G'B'
  /// and then converted: those with a source in other colours or of matched exposure, each of which
  /// would be converted before mixing, and blended ones, few in a view, where a pixel that one
  /// source does not see would share its chroma with pixels that it does.
  [[gnu::noinline]] void mix_yuv420(int tx, int ty, SourceSet sources, const TileArea& area) const {
    mix_tiles<Yuv420Tile>(
        tx, ty, sources, area,
        [&](std::size_t n, Yuv420Tile& picture) {
          tiles_[n]->write_yuv420(tx, ty, picture.picture(), {0, 0, kTile, kTile});
        },
        [&](std::span<const MixedTile> mixed) {
          kernel_.mix_yuv420(mixed, planes_at(out_, area.x, area.y));
        });
  }

  [[gnu::noinline]] void blend(int tx, int ty, SourceSet sources, const TileArea& area) const {
    std::array<Tile, kMaxSources> pictures;
    std::array<TileWeights, kMaxSources> weights;
    std::array<MergeSource<T>, kMaxSources> merged;
    TileWeights covered{};
    std::size_t count = 0;
    for_each(sources, [&](std::size_t n) {
      plan_.blend->weights(n, *sources_[n].grid, tx, ty, weights[count]);
      if (plan_.rule == MergeRule::First && !covers_more(weights[count], area, covered)) {
        if ((measured_ & set_of(n)) != 0) measure_beside(n, tx, ty, area);
        return;
      }
      write(tx, ty, n, area, pictures[count]);
      merged[count] = {pictures[count].view(), {weights[count].data(), kTile, kTile, 1, kTile}};
      ++count;
    });
    const std::span<const MergeSource<T>> list(merged.data(), count);
    show(area, [&](const MutablePicture& out, const TileArea& place) {
      merge(plan_.rule, list, part(out.samples<T>(), place), part(validity_, area), {0, 1});
    });
  }

  /// Adds the pixels that a source sees to those `covered`; false if there are no more.
  static bool covers_more(const TileWeights& weights, const TileArea& area, TileWeights& covered) {
    std::uint8_t more = 0;
    for (int y = 0; y < area.rows; ++y) {
      for (int x = 0; x < area.columns; ++x) {
        const auto at = static_cast<std::size_t>(y * kTile + x);
        const std::uint8_t seen = weights[at] != 0 ? 1 : 0;
        more |= seen & ~covered[at];
        covered[at] |= seen;
      }
    }
    return more != 0;
  }

  /// The part of the work for a view without viewers: measured planes and validity.
  [[gnu::noinline]] void measure(int tx, int ty, const TileArea& area) const {
    const auto validity = part(validity_, area);
    const SourceSet seeing = find_seeing(tx, ty);
    bool is_seen = false;
    for_each(seeing, [&](std::size_t n) { is_seen |= tiles_[n]->fills(tx, ty); });
    if (is_seen) {
      fill(validity, static_cast<std::uint8_t>(Validity::Seen));
    } else {
      copy(part(plan_.unseen, area), validity);
      for_each(seeing, [&](std::size_t n) {
        TileWeights weights;
        plan_.blend->weights(n, *sources_[n].grid, tx, ty, weights);
        for (int y = 0; y < area.rows; ++y) mark_seen(&weights[y * kTile], validity.row(y), area);
      });
    }
    for_each(measured_, [&](std::size_t n) { measure_beside(n, tx, ty, area); });
  }

  static void mark_seen(const std::uint8_t* weights, std::uint8_t* validity, const TileArea& area) {
    constexpr auto kSeen = static_cast<std::uint8_t>(Validity::Seen);
    for (int x = 0; x < area.columns; ++x) validity[x] = weights[x] != 0 ? kSeen : validity[x];
  }

  /// Writes the measured plane of a source that does not count in a tile.
  void measure_beside(std::size_t n, int tx, int ty, const TileArea& area) const {
    tiles_[n] ? tiles_[n]->measure(tx, ty) : clear_area(sources_[n].measured, area);
  }

  std::span<const MergedSource> sources_;
  const MergePlan& plan_;
  const Kernel& kernel_;
  const MutablePicture& out_;
  const ImageView<std::uint8_t>& validity_;
  SourceSet delivering_ = 0;
  SourceSet measured_ = 0;
  SourceSet yuv420_ = 0;  ///< sources whose tiles need no conversion to I420
  std::array<std::optional<SourceTiles>, kMaxSources> tiles_;  ///< set for delivering_
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
  const bool is_grey = info(out.format).colour == ColourModel::Luminance;
  const auto write = is_wide ? is_grey ? write_rows<std::uint16_t, 1> : write_rows<std::uint16_t, 3>
                     : is_grey ? write_rows<std::uint8_t, 1>
                               : write_rows<std::uint8_t, 3>;
  write(sources, plan, out, validity, rows, kernel);
}

}  // namespace orbwatch::remap
