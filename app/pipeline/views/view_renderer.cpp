#include "app/pipeline/views/view_renderer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "proc/image/image_view.h"
#include "proc/optics/resolution.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {

View make_view(const ViewPlan& plan) {
  const int width = plan.projection.width(), height = plan.projection.height();
  const auto pixels = static_cast<std::size_t>(width) * height;
  const bool is_measured = plan.measured.has_value();
  const bool is_wide =
      is_measured && info(plan.sources[*plan.measured].format.format).bytes_per_sample() == 2;
  const bool has_luminance = is_measured && !is_wide;
  View view;
  view.index = plan.index;
  view.name = plan.name;
  view.bytes.resize(pixels * (has_luminance ? 5 : 4));
  view.words.resize(is_wide ? pixels : 0);
  view.colour = {view.bytes.data(), width, height, 3, 3 * width};
  view.validity = {view.bytes.data() + 3 * pixels, width, height, 1, width};
  if (has_luminance) view.luminance = {view.bytes.data() + 4 * pixels, width, height, 1, width};
  if (is_wide) view.radiometric = {view.words.data(), width, height, 1, width};
  return view;
}

bool ViewRenderer::is_supported(PixelFormat format) { return format != PixelFormat::Rgb16; }

ViewRenderer::ViewRenderer(ViewPlan plan)
    : kernel_(&remap::default_kernel()),
      plan_(std::move(plan)),
      grids_(make_grids()),
      blend_(make_blend()),
      unseen_(make_unseen()) {}

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
  for (const auto& [camera, format, ball, weight, colours] : plan_.sources) {
    sources.push_back({ball, format.width, format.height, weight, std::nullopt});
    if (plan_.combine == Combine::Mix) {
      sources.back().enough = kWell * optics::resolution(ball, ball.facing());
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

void ViewRenderer::require_levels(MipLevelCounts& counts) const {
  for (std::size_t n = 0; n < grids_.size(); ++n) {
    int& count = counts[plan_.sources[n].camera];
    count = std::max(count, levels(n));
  }
}

void ViewRenderer::render(const hal::FrameSet& set, const FramePyramids& pyramids, View& view,
                          WorkerPool& workers) const {
  view.frame_set = set.id;
  view.stamp = set.stamp;
  view.pointing = plan_.pointing;
  view.spec = plan_.projection.spec();

  MutablePicture measured;
  if (!view.luminance.empty()) measured = picture_of(PixelFormat::Grey, view.luminance);
  if (!view.radiometric.empty()) {
    measured = picture_of(plan_.sources[*plan_.measured].format.format, view.radiometric);
  }
  render(pyramids, {picture_of(PixelFormat::Rgb, view.colour), view.validity, measured}, workers);
}

/// A camera that came after the start has another format until the view is compiled for it.
std::span<const Picture> ViewRenderer::pictures_of(std::size_t source,
                                                   const FramePyramids& pyramids) const {
  const ViewSource& from = plan_.sources[source];
  const auto pictures = pyramids.pictures(from.camera, levels(source));
  const bool fits = !pictures.empty() && pictures.front().format == from.format.format;
  return fits ? pictures : std::span<const Picture>();
}

void ViewRenderer::render(const FramePyramids& pyramids, const RenderTarget& target,
                          WorkerPool& workers) const {
  std::array<remap::MergedSource, remap::kMaxSources> sources;
  for (std::size_t n = 0; n < grids_.size(); ++n) {
    sources[n].grid = &grids_[n];
    sources[n].colours = &plan_.sources[n].colour_map;
    sources[n].pictures = pictures_of(n, pyramids);
    if (plan_.measured == n) sources[n].measured = target.measured;
    if (!matches_.empty()) sources[n].match = &matches_[n];
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

}  // namespace orbwatch::app
