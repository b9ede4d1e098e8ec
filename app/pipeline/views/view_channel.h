// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "app/model/sink/view.h"
#include "app/pipeline/views/frame_pyramids.h"
#include "app/pipeline/views/view_buffers.h"
#include "app/pipeline/views/view_plan.h"
#include "app/pipeline/views/view_renderer.h"
#include "app/pipeline/worker_pool.h"
#include "hal/sync/frame_set.h"

namespace orbwatch::app::pipeline {

/// A view on its way from frame sets to the sinks, measured or displayed. While they hold every
/// buffer of its size, a display view is skipped; a measured one is rendered into one that no sink
/// gets, so that none stops a measurement. Thread-bound: the pipeline's thread.
class ViewChannel {
 public:
  /// `plan` outlives the channel and its views.
  explicit ViewChannel(const ViewPlan& plan)
      : plan_(&plan), renderer_(std::make_unique<ViewRenderer>(plan)) {}

  const ViewPlan& plan() const { return *plan_; }

  /// Sets the format of the picture that render() and draw() make from now on, nullopt: none, and
  /// whether a display view has the counts of its radiometric camera.
  void set_reading(std::optional<PixelFormat> format, bool counts) {
    format_ = format;
    reads_counts_ = counts;
  }
  /// Colours of its one-channel cameras; valid until render() or draw() is done.
  void set_colours(ChosenColours colours) { colours_ = colours; }
  /// Adds what measure() samples.
  void add_measured_use(PictureUses& uses) const { renderer_->add_measured_use(uses); }
  /// Adds what render() and draw() sample: nothing if no sink gets what was measured.
  void add_use(PictureUses& uses) const {
    const bool is_unshared = rendered_ && !is_shared_;
    if (format_ && !is_unshared) renderer_->add_use(uses);
  }

  /// Renders a display view of a set, valid until take(); null: every buffer is held. Does not
  /// allocate.
  const View* render(const hal::FrameSet& set, const FramePyramids& pyramids, ViewBuffers& buffers,
                     WorkerPool& workers);
  /// Renders what is measured of a set, and returns it, valid until take(); draw() adds the picture
  /// that is read. Neither allocates.
  const View& measure(const hal::FrameSet& set, const FramePyramids& pyramids, ViewBuffers& buffers,
                      WorkerPool& workers);
  void draw(const FramePyramids& pyramids, WorkerPool& workers);

  /// Hands over what was rendered last; null: every buffer was held.
  ViewPtr take();

  /// Renderer in use; its projection and weights may differ from the plan's: see PanTiltZoom.
  std::unique_ptr<ViewRenderer>& renderer() { return renderer_; }

 private:
  const ViewPlan* plan_;
  std::unique_ptr<ViewRenderer> renderer_;
  std::optional<PixelFormat> format_;
  bool reads_counts_ = false;
  ChosenColours colours_;
  std::shared_ptr<View> rendered_;
  bool is_shared_ = false;  ///< sinks get rendered_
};

}  // namespace orbwatch::app::pipeline
