// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "app/pipeline/views/view_buffers.h"
#include "app/pipeline/views/view_renderer.h"

namespace orbwatch::app::pipeline {

/// Formats by camera, for the view's sources.
inline std::vector<hal::StreamFormat> source_formats(const ViewPlan& plan) {
  std::vector<hal::StreamFormat> formats;
  for (const ViewSource& source : plan.sources) {
    formats.resize(std::max(formats.size(), source.camera + 1), source.format);
    formats[source.camera] = source.format;
  }
  return formats;
}

/// View of a plan, in memory of its own.
inline View make_view(const ViewPlan& plan) {
  View view = make_view(plan.projection.width(), plan.projection.height());
  set_plan(view, plan);
  return view;
}

/// Buffers for one view, with `kept` for its readers.
inline ViewBuffers buffers_for(const ViewPlan& plan, const KeptViews& kept = {}) {
  const ViewBuffers::Views view(&plan, 1);
  return plan.measured ? ViewBuffers({}, {view}, kept) : ViewBuffers(view, {}, kept);
}

/// Pictures that a renderer samples.
inline PictureUses use_of(const ViewRenderer& renderer) {
  PictureUses uses;
  renderer.add_use(uses);
  return uses;
}

/// View rendered from frame sets like in the pipeline, into one buffer.
class RenderedView {
 public:
  explicit RenderedView(ViewPlan plan)
      : renderer_(std::move(plan)),
        uses_(use_of(renderer_)),
        pyramids_(source_formats(renderer_.plan()), uses_),
        view_(make_view(renderer_.plan())) {
    set_format(PixelFormat::Rgb);
  }

  void set_format(std::optional<PixelFormat> format) { app::pipeline::set_format(view_, format); }

  const ViewPlan& plan() const { return renderer_.plan(); }

  const View& render(const hal::FrameSet& set, WorkerPool& workers) {
    pyramids_.build(set, uses_, workers);
    renderer_.render(set, pyramids_, view_, workers);
    return view_;
  }

 private:
  ViewRenderer renderer_;
  PictureUses uses_;
  FramePyramids pyramids_;
  View view_;
};

}  // namespace orbwatch::app::pipeline
