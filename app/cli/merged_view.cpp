#include "app/cli/merged_view.h"

#include "proc/remap/blend_weights.h"
#include "proc/remap/coordinate_grid.h"
#include "proc/remap/merge.h"

namespace orbwatch::app {
namespace {

template <class T>
ImageView<T> samples(MergedView& view) {
  const Picture& picture = view.picture;
  const int channels = info(picture.format).channels;
  return {reinterpret_cast<T*>(view.pixels.data()), picture.width, picture.height, channels,
          static_cast<std::ptrdiff_t>(picture.width) * channels};
}

/// `own`: one view per picture, in which it is alone; the first becomes the merged one.
template <class T>
void merge_into_first(std::vector<MergedView>& own, std::vector<std::vector<std::uint8_t>>& weights,
                      bool match, remap::TileRows rows) {
  const Picture& picture = own.front().picture;
  std::vector<remap::MergeSource<T>> sources;
  for (std::size_t n = 0; n < own.size(); ++n) {
    sources.push_back(
        {samples<T>(own[n]), {weights[n].data(), picture.width, picture.height, 1, picture.width}});
  }
  if (match) {
    const auto transfer = remap::transfer_of(picture.format);
    own.front().matches = remap::match_photometry<T>(sources, transfer);
    for (std::size_t n = 1; n < own.size(); ++n) {
      remap::apply(own.front().matches[n], transfer, samples<T>(own[n]));
    }
  }
  remap::merge<T>(sources, samples<T>(own.front()), own.front().validity(), rows);
}

}  // namespace

MergedView::MergedView(PixelFormat format, int width, int height)
    : pixels(static_cast<std::size_t>(row_bytes(format, width)) * height),
      seen(static_cast<std::size_t>(width) * height),
      picture{format, {}, width, height, pixels.data(), row_bytes(format, width)} {}

ImageView<std::uint8_t> MergedView::validity() {
  return {seen.data(), picture.width, picture.height, 1, picture.width};
}

MergedView merge_pictures(const optics::ViewProjection& view,
                          std::span<const ViewedPicture> pictures,
                          remap::Interpolation interpolation, bool match) {
  const PixelFormat format = pictures.front().picture.format;
  const bool wide = info(format).bytes_per_sample == 2;
  std::vector<remap::CoordinateGrid> grids;
  std::vector<MergedView> own;
  for (const auto& [picture, ball] : pictures) {
    grids.emplace_back(view, ball, picture.width, picture.height);
    own.emplace_back(format, view.width(), view.height());
  }
  const remap::TileRows rows{0, grids.front().tiles_y()};
  std::vector<remap::BlendSource> sources;
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    sources.push_back({grids[n], pictures[n].ball, 1, std::nullopt});
    const Picture& picture = pictures[n].picture;
    wide ? remap::remap(grids[n], picture, interpolation, samples<std::uint16_t>(own[n]), rows)
         : remap::remap(grids[n], picture, interpolation, samples<std::uint8_t>(own[n]), rows);
  }
  auto weights = remap::blend_weights(view, sources);
  wide ? merge_into_first<std::uint16_t>(own, weights, match, rows)
       : merge_into_first<std::uint8_t>(own, weights, match, rows);
  return std::move(own.front());
}

}  // namespace orbwatch::app
