#include "app/pipeline/views/view_channel.h"

namespace orbwatch::app {

const View* ViewChannel::render(const hal::FrameSet& set, const FramePyramids& pyramids,
                                ViewBuffers& buffers, WorkerPool& workers) {
  rendered_.reset();
  rendered_ = buffers.acquire(*plan_);
  is_shared_ = rendered_ != nullptr;
  if (!rendered_ && plan_->measured) rendered_ = buffers.acquire_unshared(*plan_);
  if (!rendered_) return nullptr;
  app::set_format(*rendered_, format_);
  renderer_->render(set, pyramids, *rendered_, workers);
  return rendered_.get();
}

ViewPtr ViewChannel::take() {
  const ViewPtr rendered = std::move(rendered_);
  return is_shared_ ? rendered : nullptr;
}

}  // namespace orbwatch::app
