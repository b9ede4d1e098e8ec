// SPDX-License-Identifier: Apache-2.0
#include "app/watch/frame_set_copies.h"

#include <algorithm>
#include <string>
#include <utility>

namespace orbwatch::app {

FrameSetCopies::FrameSetCopies(std::shared_ptr<hal::SharedThreads> threads)
    : work_(std::move(threads), [this] { serve(); }) {}

void FrameSetCopies::ask(std::vector<std::size_t> cameras, Reader reader) {
  const std::lock_guard lock(mutex_);
  requests_.push_back({std::move(cameras), std::move(reader)});
  if (requests_.size() == 1) begin();
}

/// Under mutex_, while nothing is waited for.
void FrameSetCopies::begin() {
  cameras_ = requests_.front().cameras;
  since_.reset();
  is_waiting_.store(true, std::memory_order_release);
}

void FrameSetCopies::accept(const hal::FrameSet& set) {
  if (!is_waiting_.load(std::memory_order_acquire)) return;
  if (!since_) since_ = set.stamp;
  const bool is_complete = std::ranges::all_of(
      cameras_, [&](std::size_t camera) { return set.frames[camera] && !set.held[camera]; });
  if (!is_complete && set.stamp - *since_ < kPatience) return;
  if (is_complete) {
    for (const std::size_t camera : cameras_) frames_[camera] = set.frames[camera];
  }
  stamp_ = set.stamp;
  is_waiting_.store(false, std::memory_order_release);
  work_.request();
}

Result<std::vector<RecordedPicture>> FrameSetCopies::copies() const {
  std::vector<RecordedPicture> pictures;
  for (const std::size_t camera : cameras_) {
    if (!frames_[camera]) {
      return fail("no frame set of " + std::to_string(kPatience.count()) +
                  " s has a new picture of each camera: one delivers none, or they are not exposed "
                  "together");
    }
    pictures.push_back(copied(frames_[camera]->picture, stamp_.time_since_epoch()));
  }
  return pictures;
}

void FrameSetCopies::serve() {
  auto pictures = copies();
  frames_ = {};
  Request served;
  {
    const std::lock_guard lock(mutex_);
    served = std::move(requests_.front());
    requests_.pop_front();
    if (!requests_.empty()) begin();
  }
  served.reader(std::move(pictures));
}

}  // namespace orbwatch::app
