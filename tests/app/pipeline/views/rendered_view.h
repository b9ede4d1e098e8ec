#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "app/pipeline/views/view_renderer.h"

namespace orbwatch::app {

/// By camera, of those that the view has as sources.
inline std::vector<hal::StreamFormat> source_formats(const ViewPlan& plan) {
  std::vector<hal::StreamFormat> formats;
  for (const ViewSource& source : plan.sources) {
    formats.resize(std::max(formats.size(), source.camera + 1), source.format);
    formats[source.camera] = source.format;
  }
  return formats;
}

/// A view rendered from frame sets as the pipeline does it, into one buffer.
class RenderedView {
 public:
  explicit RenderedView(ViewPlan plan)
      : renderer_(std::move(plan)),
        pyramids_(source_formats(renderer_.plan())),
        view_(make_view(renderer_.plan())) {}

  const ViewPlan& plan() const { return renderer_.plan(); }

  const View& render(const hal::FrameSet& set, WorkerPool& workers) {
    MipLevelCounts levels{};
    renderer_.require_levels(levels);
    pyramids_.build(set, levels, workers);
    renderer_.render(set, pyramids_, view_, workers);
    return view_;
  }

 private:
  ViewRenderer renderer_;
  FramePyramids pyramids_;
  View view_;
};

}  // namespace orbwatch::app
