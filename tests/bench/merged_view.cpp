#include "tests/bench/merged_view.h"

#include <algorithm>

#include "proc/optics/rotation.h"

namespace orbwatch::bench {
namespace {

optics::ViewProjection projection_of(const MergedCase& wanted) {
  optics::ViewSpec spec;
  spec.kind = wanted.panorama ? optics::ViewKind::Equirectangular : optics::ViewKind::Perspective;
  spec.width = wanted.panorama ? 2048 : 1920;
  spec.height = wanted.panorama ? 1024 : 1080;
  if (!wanted.panorama) spec.h_fov = 90;
  return optics::ViewProjection::make(spec).value();
}

/// A ball that fills most of the picture's height, seen from `yaw` degrees.
optics::BallProjection ball_in(int width, int height, double yaw) {
  const double radius = 0.46 * height;
  return optics::BallProjection::make(
             optics::BallModel::make(optics::BallModel::Kind::Exact, 348.5).value(),
             {{(width - 1) / 2.0, (height - 1) / 2.0}, radius, radius, 0},
             optics::rotation({yaw, 0, 0}))
      .value();
}

remap::ColourMap::Table colour_table() {
  remap::ColourMap::Table table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto value = static_cast<std::uint8_t>(i);
    table[i] = {value, static_cast<std::uint8_t>(255 - i), static_cast<std::uint8_t>(value / 2)};
  }
  return table;
}

}  // namespace

MergedView::MergedView(const MergedCase& wanted)
    : view_(projection_of(wanted)),
      colours_(colour_table(), 5000, 60000),
      out_(Frame::blank(PixelFormat::Rgb, view_.width(), view_.height())),
      unseen_(Frame::blank(PixelFormat::Grey, view_.width(), view_.height())),
      validity_(Frame::blank(PixelFormat::Grey, view_.width(), view_.height())) {
  std::vector<remap::BlendSource> blended;
  for (std::size_t n = 0; n < wanted.count; ++n) {
    const PixelFormat format = wanted.sources[n];
    const bool thermal = format == PixelFormat::Y16;
    const int width = thermal ? 640 : 1920, height = thermal ? 512 : 1080;
    const auto ball = ball_in(width, height, wanted.panorama ? 120.0 * static_cast<double>(n) : 0);
    auto& camera = cameras_.emplace_back(
        Camera{Frame::blank(format, width, height), {}, ball, {view_, ball, width, height}});
    camera.frame.fill_with_noise(static_cast<unsigned>(n + 1));
    camera.picture = std::as_const(camera.frame).picture();
    const std::optional<double> enough =
        wanted.panorama ? std::nullopt : std::optional<double>(0.01);
    blended.push_back({camera.ball, width, height, 1, enough});
    sources_.push_back({&camera.grid, {&camera.picture, 1}, &colours_, {}, nullptr});
  }
  blend_.emplace(view_, blended);
  if (!wanted.measured) return;
  measured_ = Frame::blank(wanted.sources[wanted.count - 1], view_.width(), view_.height());
  sources_.back().measured = measured_->picture();
}

void MergedView::run() {
  const auto plane = [](Frame& frame) {
    return ImageView<std::uint8_t>{reinterpret_cast<std::uint8_t*>(frame.planes[0].bytes.data()),
                                   frame.width, frame.height, 1, frame.planes[0].stride};
  };
  const remap::MergePlan plan{&*blend_, remap::MergeRule::Mean, remap::Interpolation::Bilinear,
                              plane(unseen_)};
  remap::merged_remap(sources_, plan, out_.picture(), plane(validity_),
                      {0, cameras_.front().grid.tiles_y()});
}

}  // namespace orbwatch::bench
