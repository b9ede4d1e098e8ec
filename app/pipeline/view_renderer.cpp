#include "app/pipeline/view_renderer.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "proc/image/validity.h"
#include "proc/optics/resolution.h"
#include "proc/remap/blend_weights.h"
#include "proc/remap/colour_conversion.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {
namespace {

bool is_one_channel(PixelFormat format) { return remap::remapped_channels(format) == 1; }
bool is_sixteen_bit(PixelFormat format) { return info(format).bytes_per_sample == 2; }

void clear_measured(const View& view, int first, int last) {
  for (int y = first; y < last; ++y) {
    if (!view.luminance.empty()) std::fill_n(view.luminance.row(y), view.luminance.width, 0);
    if (!view.radiometric.empty()) std::fill_n(view.radiometric.row(y), view.radiometric.width, 0);
  }
}

void write_luma(const ImageView<std::uint8_t>& rgb, const ImageView<std::uint8_t>& luminance,
                remap::TileRows rows) {
  const int last = std::min(rows.last * remap::kTile, rgb.height);
  for (int y = rows.first * remap::kTile; y < last; ++y) {
    for (int x = 0; x < rgb.width; ++x) luminance.row(y)[x] = remap::luma(rgb.at(x, y));
  }
}

}  // namespace

bool ViewRenderer::is_supported(PixelFormat format) { return format != PixelFormat::Rgb16; }

ViewRenderer::ViewRenderer(ViewPlan plan) : plan_(std::move(plan)) {
  const auto pixels =
      static_cast<std::size_t>(plan_.projection.width()) * plan_.projection.height();
  for (const ViewSource& source : plan_.sources) {
    Source compiled{remap::CoordinateGrid(plan_.projection, source.ball, source.format.width,
                                          source.format.height),
                    {},
                    {},
                    {},
                    {}};
    if (plan_.sources.size() > 1) compiled.rgb.resize(pixels * 3);
    if (is_one_channel(source.format.format)) {
      is_sixteen_bit(source.format.format) ? compiled.counts.resize(pixels)
                                           : compiled.grey.resize(pixels);
    }
    sources_.push_back(std::move(compiled));
  }
  compile_weights();
  compile_unseen();
}

template <class T>
ImageView<T> ViewRenderer::plane(std::vector<T>& storage, int channels) const {
  const int width = plan_.projection.width();
  return {storage.data(), width, plan_.projection.height(), channels, width * channels};
}

void ViewRenderer::compile_weights() {
  // A camera sees well up to about 150 degrees from its own direction.
  constexpr double kWell = 1.0 / 4;
  std::vector<remap::BlendSource> sources;
  for (std::size_t n = 0; n < sources_.size(); ++n) {
    const auto& [camera, format, ball, weight, colours] = plan_.sources[n];
    sources.push_back({sources_[n].grid, ball, weight, std::nullopt});
    if (plan_.combine == Combine::Mix) {
      sources.back().enough = kWell * optics::resolution(ball, ball.facing());
    }
  }
  auto weights = remap::blend_weights(plan_.projection, sources);
  for (std::size_t n = 0; n < sources_.size(); ++n) sources_[n].weights = std::move(weights[n]);
}

void ViewRenderer::compile_unseen() {
  const auto pixels =
      static_cast<std::size_t>(plan_.projection.width()) * plan_.projection.height();
  unseen_.assign(pixels, static_cast<std::uint8_t>(Validity::Outside));
  std::vector<std::uint8_t> validity(pixels);
  for (const Source& source : sources_) {
    source.grid.write_validity(plane(validity, 1));
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
  measured_delivers_ = plan_.measured && set.frames[plan_.sources[*plan_.measured].camera];
  const int tile_rows = sources_.front().grid.tiles_y();
  auto work = [&](int row) { render_rows(set, view, {row, row + 1}); };
  workers.run(tile_rows, work);
}

void ViewRenderer::render_rows(const hal::FrameSet& set, View& view, remap::TileRows rows) {
  const int first = rows.first * remap::kTile;
  const int last = std::min(rows.last * remap::kTile, plan_.projection.height());
  const std::ptrdiff_t width = plan_.projection.width();
  std::copy_n(unseen_.data() + first * width, (last - first) * width, view.validity.row(first));

  std::array<remap::MergeSource<std::uint8_t>, remap::kMaxSources> delivering;
  std::size_t count = 0;
  for (std::size_t n = 0; n < sources_.size(); ++n) {
    const auto& frame = set.frames[plan_.sources[n].camera];
    const auto rgb = sources_.size() > 1 ? plane(sources_[n].rgb, 3) : view.colour;
    if (frame) {
      render_source(n, frame->picture, view, rgb, rows);
      delivering[count++] = {rgb, plane(sources_[n].weights, 1)};
    } else if (plan_.measured == n) {
      clear_measured(view, first, last);
    }
  }
  merge(std::span(delivering.data(), count), view, rows);
}

void ViewRenderer::merge(std::span<const remap::MergeSource<std::uint8_t>> delivering,
                         const View& view, remap::TileRows rows) const {
  switch (plan_.combine) {
    case Combine::Mix:
    case Combine::Sharpest:
      remap::merge<std::uint8_t>(delivering, view.colour, view.validity, rows);
      break;
    case Combine::Switch:
      remap::merge_first<std::uint8_t>(delivering, view.colour, view.validity, rows);
      break;
  }
}

void ViewRenderer::render_source(std::size_t n, const Picture& picture, View& view,
                                 const ImageView<std::uint8_t>& rgb, remap::TileRows rows) {
  Source& source = sources_[n];
  const bool measured = plan_.measured == n;
  const remap::ColourMap& colours = plan_.sources[n].colour_map;
  if (!is_one_channel(picture.format)) {
    remap::remap(source.grid, picture, plan_.interpolation, rgb, rows);
    if (measured) write_luma(rgb, view.luminance, rows);
  } else if (is_sixteen_bit(picture.format)) {
    const auto counts = measured ? view.radiometric : plane(source.counts, 1);
    remap::remap(source.grid, picture, plan_.interpolation, counts, rows);
    colours.apply(counts, rgb, rows);
  } else {
    const auto grey = measured ? view.luminance : plane(source.grey, 1);
    remap::remap(source.grid, picture, plan_.interpolation, grey, rows);
    colours.apply(grey, rgb, rows);
  }
}

}  // namespace orbwatch::app
