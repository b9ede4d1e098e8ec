// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/merged_view.h"

#include <utility>

#include "tests/bench/ball_in_picture.h"

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

bool is_thermal(PixelFormat format) { return format == PixelFormat::Y16; }
int width_of(PixelFormat format) { return is_thermal(format) ? 640 : 1920; }
int height_of(PixelFormat format) { return is_thermal(format) ? 512 : 1080; }

}  // namespace

MergedCamera::MergedCamera(PixelFormat format, const optics::ViewProjection& view, double yaw,
                           unsigned seed)
    : frame(Frame::blank(format, width_of(format), height_of(format))),
      ball(ball_in_picture(frame.width, frame.height, yaw)),
      grid(view, ball, frame.width, frame.height) {
  frame.fill_with_waves(seed);
  picture = std::as_const(frame).picture();
}

ColourScale scale_of(PixelFormat format) {
  return is_thermal(format) ? ColourScale{ramp(), 5000, 60000} : ColourScale{ramp(), 0, 255};
}

MergedView::MergedView(const MergedCase& wanted, const remap::Kernel& kernel)
    : kernel_(kernel),
      view_(projection_of(wanted)),
      out_(Frame::blank(PixelFormat::Rgb, view_.width(), view_.height())),
      unseen_(Frame::blank(PixelFormat::Grey, view_.width(), view_.height())),
      validity_(Frame::blank(PixelFormat::Grey, view_.width(), view_.height())) {
  const std::optional<double> enough = wanted.panorama ? std::nullopt : std::optional(0.01);
  std::vector<remap::BlendSource> blended;
  for (std::size_t n = 0; n < wanted.count; ++n) {
    const PixelFormat format = wanted.sources[n];
    const double yaw = wanted.panorama ? 120.0 * static_cast<double>(n) : 0;
    const auto& camera = cameras_.emplace_back(format, view_, yaw, static_cast<unsigned>(n + 1));
    const auto [table, low, high] = scale_of(format);
    const auto& colours = colours_.emplace_back(table, low, high);
    blended.push_back({camera.ball, camera.frame.width, camera.frame.height, 1, enough});
    sources_.push_back({&camera.grid, {&camera.picture, 1}, &colours, {}, nullptr});
  }
  blend_.emplace(view_, blended);
  if (!wanted.measured) return;
  const PixelFormat measured = wanted.sources[wanted.count - 1];
  measured_ = Frame::blank(is_thermal(measured) ? measured : PixelFormat::Grey, view_.width(),
                           view_.height());
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
                      {0, cameras_.front().grid.tiles_y()}, kernel_);
}

}  // namespace orbwatch::bench
