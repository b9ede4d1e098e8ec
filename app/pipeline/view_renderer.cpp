#include "app/pipeline/view_renderer.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "proc/image/validity.h"
#include "proc/optics/resolution.h"

namespace orbwatch::app {
namespace {

bool is_sixteen_bit(PixelFormat format) { return info(format).bytes_per_sample() == 2; }

}  // namespace

bool ViewRenderer::is_supported(PixelFormat format) { return format != PixelFormat::Rgb16; }

ViewRenderer::ViewRenderer(ViewPlan plan)
    : kernel_(&remap::default_kernel()),
      plan_(std::move(plan)),
      sources_(make_sources()),
      blend_(make_blend()) {
  compile_unseen();
}

std::vector<ViewRenderer::Source> ViewRenderer::make_sources() const {
  std::vector<Source> sources;
  for (const ViewSource& source : plan_.sources) {
    const auto& [format, colour_space, width, height, rate] = source.format;
    remap::CoordinateGrid grid(plan_.projection, source.ball, width, height);
    const bool averaged = plan_.interpolation == remap::Interpolation::Area;
    remap::Pyramid pyramid(format, width, height, averaged ? grid.halves() : 0);
    sources.push_back({std::move(grid), std::move(pyramid)});
  }
  return sources;
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

ImageView<std::uint8_t> ViewRenderer::plane(std::vector<std::uint8_t>& storage) const {
  const int width = plan_.projection.width();
  return {storage.data(), width, plan_.projection.height(), 1, width};
}

void ViewRenderer::compile_unseen() {
  const auto pixels =
      static_cast<std::size_t>(plan_.projection.width()) * plan_.projection.height();
  unseen_.assign(pixels, static_cast<std::uint8_t>(Validity::Outside));
  std::vector<std::uint8_t> validity(pixels);
  for (const Source& source : sources_) {
    source.grid.write_validity(plane(validity));
    for (std::size_t i = 0; i < pixels; ++i) {
      if (validity[i] != static_cast<std::uint8_t>(Validity::Outside)) {
        unseen_[i] = static_cast<std::uint8_t>(Validity::Blind);
      }
    }
  }
}

View ViewRenderer::make_view() const {
  const int width = plan_.projection.width(), height = plan_.projection.height();
  const auto pixels = static_cast<std::size_t>(width) * height;
  const bool wide = plan_.measured && is_sixteen_bit(plan_.sources[*plan_.measured].format.format);
  const bool narrow = plan_.measured && !wide;
  View view;
  view.index = plan_.index;
  view.name = plan_.name;
  view.bytes.resize(pixels * (narrow ? 5 : 4));
  view.words.resize(wide ? pixels : 0);
  view.colour = {view.bytes.data(), width, height, 3, 3 * width};
  view.validity = {view.bytes.data() + 3 * pixels, width, height, 1, width};
  if (narrow) view.luminance = {view.bytes.data() + 4 * pixels, width, height, 1, width};
  if (wide) view.radiometric = {view.words.data(), width, height, 1, width};
  return view;
}

void ViewRenderer::render(const hal::FrameSet& set, View& view, WorkerPool& workers) {
  view.frame_set = set.id;
  view.stamp = set.stamp;
  view.spec = plan_.projection.spec();
  fill_pyramids(set, workers);

  std::array<remap::MergedSource, remap::kMaxSources> sources;
  for (std::size_t n = 0; n < sources_.size(); ++n) {
    sources[n].grid = &sources_[n].grid;
    sources[n].colours = &plan_.sources[n].colour_map;
    if (set.frames[plan_.sources[n].camera]) sources[n].pictures = sources_[n].pyramid.pictures();
    if (plan_.measured != n) continue;
    sources[n].measured = view.radiometric.empty()
                              ? picture_of(PixelFormat::Grey, view.luminance)
                              : picture_of(plan_.sources[n].format.format, view.radiometric);
  }
  const remap::MergePlan plan{
      &blend_, plan_.combine == Combine::Switch ? remap::MergeRule::First : remap::MergeRule::Mean,
      plan_.interpolation, plane(unseen_)};
  auto work = [&](int row) {
    remap::merged_remap({sources.data(), sources_.size()}, plan, view.colour, view.validity,
                        {row, row + 1}, *kernel_);
  };
  workers.run(sources_.front().grid.tiles_y(), work);
}

/// Halves the pictures that delivered, where this view is smaller than they are.
void ViewRenderer::fill_pyramids(const hal::FrameSet& set, WorkerPool& workers) {
  // In bands of so many pairs of rows.
  constexpr int kBand = 16;
  for (std::size_t n = 0; n < sources_.size(); ++n) {
    const auto& frame = set.frames[plan_.sources[n].camera];
    if (!frame) continue;
    remap::Pyramid& pyramid = sources_[n].pyramid;
    pyramid.set_source(frame->picture);
    for (int level = 1; level <= pyramid.levels(); ++level) {
      auto work = [&](int band) {
        const int pairs = pyramid.row_pairs(level);
        pyramid.fill(level, band * kBand, std::min(pairs, (band + 1) * kBand));
      };
      workers.run((pyramid.row_pairs(level) + kBand - 1) / kBand, work);
    }
  }
}

}  // namespace orbwatch::app
