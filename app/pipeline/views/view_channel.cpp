#include "app/pipeline/views/view_channel.h"

#include <vector>

namespace orbwatch::app {
namespace {

hal::BufferPool<View> make_pool(const ViewPlan& plan) {
  std::vector<std::unique_ptr<View>> buffers;
  for (std::size_t i = 0; i < kViewBuffers; ++i) {
    buffers.push_back(std::make_unique<View>(make_view(plan)));
  }
  return hal::BufferPool<View>(std::move(buffers));
}

}  // namespace

ViewChannel::ViewChannel(const ViewPlan& plan)
    : plan_(&plan), renderer_(std::make_unique<ViewRenderer>(plan)), pool_(make_pool(plan)) {
  if (plan.measured) unshared_ = make_view(plan);
}

const View* ViewChannel::render(const hal::FrameSet& set, const FramePyramids& pyramids,
                                WorkerPool& workers) {
  rendered_.reset();
  rendered_ = pool_.acquire();
  View* view = rendered_ ? rendered_.get() : unshared_ ? &*unshared_ : nullptr;
  if (view) renderer_->render(set, pyramids, *view, workers);
  return view;
}

}  // namespace orbwatch::app
