// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/still_view.h"

#include <memory>
#include <utility>

#include "app/pipeline/views/frame_pyramids.h"
#include "app/pipeline/views/view_renderer.h"
#include "app/pipeline/worker_pool.h"

namespace orbwatch::app::pipeline {

StillView::StillView(PixelFormat format, int width, int height)
    : pixels(picture_bytes(format, row_bytes(format, width), height)),
      validity(static_cast<std::size_t>(width) * height),
      picture(MutablePicture::contiguous(format, width, height, pixels.data(),
                                         row_bytes(format, width))) {}

StillView render_once(const StillPlan& plan, std::span<const StillSource> sources) {
  const remap::ColourMap unused({}, 0, 255);  // one-channel pictures keep their format
  ViewPlan view{0, "still", plan.projection, {}, plan.combine, plan.interpolation, std::nullopt};
  std::vector<hal::StreamFormat> formats;
  hal::FrameSet set;
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const auto& [picture, ball, sharpness] = sources[n];
    const auto frame = std::make_shared<hal::FrameBuffer>();
    frame->picture = picture;
    formats.push_back({picture.format, picture.colour_space, picture.width, picture.height, 0});
    view.sources.push_back({n, formats.back(), ball, 1, unused, sharpness});
    set.frames[n] = frame;
  }
  WorkerPool workers(0);
  ViewRenderer renderer(std::move(view));
  PictureUses uses;
  renderer.add_use(uses);
  FramePyramids pyramids(formats, uses);
  pyramids.build(set, uses, workers);
  StillView still(plan.format, plan.projection.width(), plan.projection.height());
  if (plan.match && sources.size() > 1) still.matches = renderer.match_photometry(pyramids);
  renderer.render(pyramids, {still.picture, still.validity_plane(), {}, true}, workers);
  return still;
}

}  // namespace orbwatch::app::pipeline
