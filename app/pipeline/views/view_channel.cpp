// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/view_channel.h"

namespace orbwatch::app::pipeline {

const View* ViewChannel::render(const hal::FrameSet& set, const FramePyramids& pyramids,
                                ViewBuffers& buffers, WorkerPool& workers) {
  rendered_.reset();
  rendered_ = buffers.acquire(*plan_);
  is_shared_ = rendered_ != nullptr;
  if (!rendered_ && plan_->measured) rendered_ = buffers.acquire_unshared(*plan_);
  if (!rendered_) return nullptr;
  set_format(*rendered_, format_);
  // A camera that came after the start may deliver another format than the channel's plan says.
  if (reads_counts_ && !plan_->measured && renderer_->has_counts()) add_counts(*rendered_);
  renderer_->render(set, pyramids, *rendered_, workers, colours_);
  return rendered_.get();
}

ViewPtr ViewChannel::take() {
  const ViewPtr rendered = std::move(rendered_);
  return is_shared_ ? rendered : nullptr;
}

}  // namespace orbwatch::app::pipeline
