// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/view_channel.h"

#include <utility>

namespace orbwatch::app::pipeline {

const View* ViewChannel::render(const hal::FrameSet& set, const FramePyramids& pyramids,
                                ViewBuffers& buffers, WorkerPool& workers) {
  rendered_.reset();
  rendered_ = buffers.acquire(*plan_);
  is_shared_ = rendered_ != nullptr;
  if (!rendered_) return nullptr;
  set_format(*rendered_, format_);
  // A camera that came after the start may deliver another format than the channel's plan says.
  if (reads_counts_ && renderer_->has_counts()) add_counts(*rendered_);
  renderer_->render(set, pyramids, *rendered_, workers, colours_);
  return rendered_.get();
}

const View& ViewChannel::measure(const hal::FrameSet& set, const FramePyramids& pyramids,
                                 ViewBuffers& buffers, WorkerPool& workers) {
  rendered_.reset();
  rendered_ = buffers.acquire(*plan_);
  is_shared_ = rendered_ != nullptr;
  if (!rendered_) rendered_ = buffers.acquire_unshared(*plan_);
  renderer_->measure(set, pyramids, *rendered_, workers);
  return *rendered_;
}

void ViewChannel::draw(const FramePyramids& pyramids, WorkerPool& workers) {
  if (!is_shared_) return;
  set_format(*rendered_, format_);
  renderer_->draw(pyramids, *rendered_, workers, colours_);
}

ViewPtr ViewChannel::take() {
  const ViewPtr rendered = std::move(rendered_);
  return std::exchange(is_shared_, false) ? rendered : nullptr;
}

}  // namespace orbwatch::app::pipeline
