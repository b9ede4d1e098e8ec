#pragma once

#include <memory>
#include <optional>
#include <span>

#include "app/model/view.h"
#include "app/pipeline/views/frame_pyramids.h"
#include "app/pipeline/views/view_plan.h"
#include "app/pipeline/views/view_renderer.h"
#include "app/pipeline/worker_pool.h"
#include "hal/frame/buffer_pool.h"
#include "hal/sync/frame_set.h"

namespace orbwatch::app {

/// A view on its way from frame sets to the sinks, measured or displayed: its renderer and its
/// buffers, which the sinks share. While they hold every one, a display view is skipped; a measured
/// one is rendered into a buffer of its own, so that no sink stops a measurement.
/// Thread-bound: the pipeline's thread.
class ViewChannel {
 public:
  /// `plan` outlives the channel and its views.
  explicit ViewChannel(const ViewPlan& plan);

  const ViewPlan& plan() const { return *plan_; }

  /// Raises `counts` to the mip levels that render() samples.
  void require_levels(MipLevelCounts& counts) const { renderer_->require_levels(counts); }

  /// The view of a set, valid until the next call; null: every buffer is held. Does not allocate.
  const View* render(const hal::FrameSet& set, const FramePyramids& pyramids, WorkerPool& workers);

  /// Hands over what was rendered last; null: every buffer was held.
  ViewPtr take() { return std::move(rendered_); }

  /// Of another projection or other weights, but of the plan's size and sources: see PanTiltZoom.
  std::unique_ptr<ViewRenderer>& renderer() { return renderer_; }

 private:
  const ViewPlan* plan_;
  std::unique_ptr<ViewRenderer> renderer_;
  hal::BufferPool<View> pool_;
  std::optional<View> unshared_;  ///< of a measured view
  std::shared_ptr<View> rendered_;
};

}  // namespace orbwatch::app
