#include "app/cli/merged_view.h"

#include "proc/remap/blend_grid.h"
#include "proc/remap/coordinate_grid.h"
#include "proc/remap/merge.h"
#include "proc/remap/pyramid.h"

namespace orbwatch::app {
namespace {

void remap_alone(const Picture& picture, const remap::CoordinateGrid& grid,
                 remap::Interpolation interpolation, MergedView& view) {
  remap::Pyramid pyramid(picture.format, picture.width, picture.height, grid.halves());
  pyramid.set_source(picture);
  pyramid.fill();
  remap::remap(grid, pyramid.pictures(), interpolation, view.picture, {0, grid.tiles_y()});
}

/// `own`: one view per picture, in which it is alone; the first becomes the merged one.
template <class T>
void merge_into_first(std::vector<MergedView>& own, std::vector<std::vector<std::uint8_t>>& weights,
                      bool match, remap::TileRows rows) {
  const MutablePicture& picture = own.front().picture;
  std::vector<remap::MergeSource<T>> sources;
  for (std::size_t n = 0; n < own.size(); ++n) {
    sources.push_back({own[n].picture.samples<T>(),
                       {weights[n].data(), picture.width, picture.height, 1, picture.width}});
  }
  if (match) {
    const auto transfer = remap::transfer_of(picture.format);
    own.front().matches = remap::match_photometry<T>(sources, transfer);
    for (std::size_t n = 1; n < own.size(); ++n) {
      remap::apply(own.front().matches[n], transfer, own[n].picture.samples<T>());
    }
  }
  remap::merge<T>(sources, own.front().picture.samples<T>(), own.front().validity(), rows);
}

}  // namespace

MergedView::MergedView(PixelFormat format, int width, int height)
    : pixels(static_cast<std::size_t>(row_bytes(format, width)) * height),
      seen(static_cast<std::size_t>(width) * height),
      picture(MutablePicture::contiguous(format, width, height, pixels.data(),
                                         row_bytes(format, width))) {}

ImageView<std::uint8_t> MergedView::validity() {
  return {seen.data(), picture.width, picture.height, 1, picture.width};
}

MergedView merge_pictures(const optics::ViewProjection& view,
                          std::span<const ViewedPicture> pictures,
                          remap::Interpolation interpolation, bool match) {
  const PixelFormat format = pictures.front().picture.format;
  std::vector<remap::CoordinateGrid> grids;
  std::vector<remap::BlendSource> sources;
  std::vector<MergedView> own;
  for (const auto& [picture, ball] : pictures) {
    grids.emplace_back(view, ball, picture.width, picture.height);
    sources.push_back({ball, picture.width, picture.height, 1, std::nullopt});
    own.emplace_back(format, view.width(), view.height());
    remap_alone(picture, grids.back(), interpolation, own.back());
  }
  const remap::BlendGrid blend(view, sources);
  std::vector<std::vector<std::uint8_t>> weights;
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    auto& plane = weights.emplace_back(own[n].seen.size());
    blend.weights(n, grids[n], {plane.data(), view.width(), view.height(), 1, view.width()});
  }
  const remap::TileRows rows{0, grids.front().tiles_y()};
  info(format).bytes_per_sample() == 2 ? merge_into_first<std::uint16_t>(own, weights, match, rows)
                                       : merge_into_first<std::uint8_t>(own, weights, match, rows);
  return std::move(own.front());
}

}  // namespace orbwatch::app
