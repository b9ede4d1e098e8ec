// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/view_renderer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "proc/image/image_view.h"
#include "proc/optics/resolution.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::pipeline {

bool ViewRenderer::is_supported(PixelFormat format) { return format != PixelFormat::Rgb16; }

ViewRenderer::ViewRenderer(ViewPlan plan)
    : kernel_(&remap::default_kernel()),
      plan_(std::move(plan)),
      raw_(plan_.raw()),
      grids_(make_grids()),
      blend_(make_blend()),
      sharpened_(find_sharpened()),
      unseen_(make_unseen()),
      is_matched_(plan_.match && std::ranges::count_if(plan_.sources, is_colour) > 1) {}

std::vector<remap::CoordinateGrid> ViewRenderer::make_grids() const {
  std::vector<remap::CoordinateGrid> grids;
  grids.reserve(plan_.sources.size());
  for (const ViewSource& source : plan_.sources) {
    grids.emplace_back(plan_.projection, source.ball, source.format.width, source.format.height);
  }
  return grids;
}

remap::BlendGrid ViewRenderer::make_blend() const {
  // A camera sees well up to about 150 degrees from its own direction.
  constexpr double kWell = 1.0 / 4;
  std::vector<remap::BlendSource> sources;
  for (const ViewSource& from : plan_.sources) {
    sources.push_back({from.ball, from.format.width, from.format.height, from.weight, {}});
    if (plan_.combine == Combine::Mix) {
      sources.back().enough = kWell * optics::resolution(from.ball, from.ball.facing());
    }
  }
  return {plan_.projection, sources};
}

std::vector<std::uint8_t> ViewRenderer::make_unseen() const {
  const int width = plan_.projection.width(), height = plan_.projection.height();
  const auto pixels = static_cast<std::size_t>(width) * height;
  std::vector<std::uint8_t> unseen(pixels, static_cast<std::uint8_t>(Validity::Outside));
  std::vector<std::uint8_t> validity(pixels);
  for (const remap::CoordinateGrid& grid : grids_) {
    grid.write_validity({validity.data(), width, height, 1, width});
    for (std::size_t i = 0; i < pixels; ++i) {
      if (validity[i] != static_cast<std::uint8_t>(Validity::Outside)) {
        unseen[i] = static_cast<std::uint8_t>(Validity::Blind);
      }
    }
  }
  return unseen;
}

int ViewRenderer::levels(std::size_t source) const {
  return remap::uses_mip_levels(plan_.interpolation) ? grids_[source].pyramid_levels() : 0;
}

/// Sharpening makes up for what interpolation blurs.
double ViewRenderer::sharpness(std::size_t source) const {
  const ViewSource& from = plan_.sources[source];
  const bool is_blurred = plan_.interpolation != remap::Interpolation::Nearest;
  return is_blurred && remap::can_sharpen(from.format.format) ? from.sharpness : 0;
}

std::vector<remap::SourceArea> ViewRenderer::find_sharpened() const {
  std::vector<remap::SourceArea> areas(grids_.size());
  for (std::size_t n = 0; n < areas.size(); ++n) {
    if (sharpness(n) > 0) areas[n] = grids_[n].sampled_area();
  }
  return areas;
}

void ViewRenderer::add_measured_use(PictureUses& uses) const {
  if (!plan_.measured) return;
  PictureUse& use = uses[plan_.sources[*plan_.measured].camera];
  use.mip_levels = std::max(use.mip_levels, levels(*plan_.measured));
}

void ViewRenderer::add_use(PictureUses& uses) const {
  for (std::size_t n = 0; n < grids_.size(); ++n) {
    PictureUse& use = uses[plan_.sources[n].camera];
    use.mip_levels = std::max(use.mip_levels, levels(n));
    use.add(sharpness(n), sharpened_[n]);
  }
}

/// Writes set, direction, projection and shares into the view.
void ViewRenderer::describe(const hal::FrameSet& set, View& view) const {
  view.frame_set = set.id;
  view.stamp = set.stamp;
  view.pointing = plan_.pointing;
  view.spec = plan_.projection.spec();
  view.weights.fill(0);
  for (std::size_t n = 0; n < plan_.sources.size(); ++n) view.weights[n] = plan_.sources[n].weight;
  const hal::StreamFormat raw = has_counts() ? plan_.sources[*raw_].format : hal::StreamFormat();
  view.kelvin_per_count = raw.kelvin_per_count;
  view.kelvin_offset = raw.kelvin_offset;
}

void ViewRenderer::describe_colours(View& view, ChosenColours colours) const {
  view.colours.fill(std::nullopt);
  for (std::size_t n = 0; n < plan_.sources.size(); ++n) {
    const ViewSource& source = plan_.sources[n];
    if (is_colour(source)) continue;
    const bool is_chosen = n < colours.size() && colours[n];
    view.colours[n] = is_chosen ? colours[n]->stated : source.colours;
  }
}

/// Plane of the view that is measured, or that has the counts beside a picture; no data: none.
MutablePicture ViewRenderer::measured_plane(View& view) const {
  if (!view.luminance.empty()) return picture_of(PixelFormat::Grey, view.luminance);
  const auto& words = view.radiometric.empty() ? view.counts : view.radiometric;
  return words.empty() ? MutablePicture() : picture_of(plan_.sources[*raw_].format.format, words);
}

void ViewRenderer::render(const hal::FrameSet& set, const FramePyramids& pyramids, View& view,
                          WorkerPool& workers, ChosenColours colours) const {
  describe(set, view);
  describe_colours(view, colours);
  const MutablePicture measured = measured_plane(view);
  if (view.picture.planes[0].data == nullptr && measured.planes[0].data == nullptr) return;
  render(pyramids, {view.picture, view.validity, measured, false, colours}, workers);
}

void ViewRenderer::measure(const hal::FrameSet& set, const FramePyramids& pyramids, View& view,
                           WorkerPool& workers) const {
  describe(set, view);
  render(pyramids, {{}, view.validity, measured_plane(view)}, workers);
}

void ViewRenderer::draw(const FramePyramids& pyramids, View& view, WorkerPool& workers,
                        ChosenColours colours) const {
  describe_colours(view, colours);
  if (view.picture.planes[0].data == nullptr) return;
  render(pyramids, {view.picture, view.validity, measured_plane(view), false, colours, true},
         workers);
}

/// A camera that came after the start has another format until the view is compiled for it.
std::span<const Picture> ViewRenderer::pictures_of(std::size_t source,
                                                   const FramePyramids& pyramids,
                                                   double sharpness) const {
  const ViewSource& from = plan_.sources[source];
  const auto pictures = pyramids.pictures(from.camera, levels(source), sharpness);
  const bool fits = !pictures.empty() && pictures.front().format == from.format.format;
  return fits ? pictures : std::span<const Picture>();
}

void ViewRenderer::render(const FramePyramids& pyramids, const RenderTarget& target,
                          WorkerPool& workers) const {
  std::array<remap::MergedSource, remap::kMaxSources> sources;
  for (std::size_t n = 0; n < grids_.size(); ++n) {
    sources[n].grid = &grids_[n];
    const bool is_chosen = n < target.colours.size() && target.colours[n];
    const remap::ColourMap& map = is_chosen ? target.colours[n]->map : plan_.sources[n].colour_map;
    if (!target.is_raw) sources[n].colours = &map;
    sources[n].pictures = pictures_of(n, pyramids, sharpness(n));
    if (raw_ == n) {
      sources[n].measured = target.measured;
      sources[n].is_measured_before = target.is_measured_before;
      sources[n].measured_pictures = pictures_of(n, pyramids, 0);
    }
    if (!matches_.empty()) {
      sources[n].match = &matches_[n];
    } else if (is_matched_) {
      sources[n].match = pyramids.match(plan_.sources[n].camera);
    }
  }
  const int width = plan_.projection.width();
  const remap::MergePlan plan{
      &blend_,
      plan_.combine == Combine::Switch ? remap::MergeRule::First : remap::MergeRule::Mean,
      plan_.interpolation,
      {unseen_.data(), width, plan_.projection.height(), 1, width}};
  auto work = [&](int row) {
    remap::merged_remap({sources.data(), grids_.size()}, plan, target.picture, target.validity,
                        {row, row + 1}, *kernel_);
  };
  workers.run(grids_.front().tiles_y(), work);
}

std::vector<remap::PhotometricMatch> ViewRenderer::match_photometry(const FramePyramids& pyramids) {
  const PixelFormat format = plan_.sources.front().format.format;
  const auto matches = info(format).bytes_per_sample() == 2
                           ? compare_sources<std::uint16_t>(pyramids)
                           : compare_sources<std::uint8_t>(pyramids);
  matches_.clear();
  for (const remap::PhotometricMatch& match : matches) matches_.emplace_back(match, format);
  return matches;
}

template <class T>
std::vector<remap::PhotometricMatch> ViewRenderer::compare_sources(
    const FramePyramids& pyramids) const {
  const PixelFormat format = plan_.sources.front().format.format;
  const int width = plan_.projection.width(), height = plan_.projection.height();
  const int channels = info(format).channels();
  const auto pixels = static_cast<std::size_t>(width) * height;
  std::vector<std::vector<T>> pictures;
  std::vector<std::vector<std::uint8_t>> weights;
  std::vector<remap::MergeSource<T>> alone;
  for (std::size_t n = 0; n < grids_.size(); ++n) {
    const ImageView<T> picture{pictures.emplace_back(pixels * channels).data(), width, height,
                               channels, channels * width};
    const ImageView<std::uint8_t> weight{weights.emplace_back(pixels).data(), width, height, 1,
                                         width};
    remap::remap(grids_[n], pyramids.pictures(plan_.sources[n].camera, levels(n)),
                 plan_.interpolation, picture_of(format, picture), {0, grids_[n].tiles_y()},
                 *kernel_);
    blend_.weights(n, grids_[n], weight);
    alone.push_back({picture, weight});
  }
  return remap::match_photometry<T>(alone, remap::transfer_of(format));
}

}  // namespace orbwatch::app::pipeline
