// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/recent_views.h"

#include <algorithm>
#include <utility>

namespace orbwatch::app::web {

void RecentViews::point(std::size_t view, hal::TimePoint now) {
  if (view < kMaxViews) pointed_until_[view] = now + kPointing;
}

bool RecentViews::wants(std::size_t view, hal::TimePoint now) const {
  return view < kMaxViews && now < pointed_until_[view].load();
}

void RecentViews::keep(ViewPtr view, std::uint64_t number) {
  // The replaced view is released after the lock.
  Kept kept{std::move(view), number};
  const std::lock_guard lock(mutex_);
  std::swap(kept_[oldest_], kept);
  oldest_ = (oldest_ + 1) % kMost;
}

ViewPtr RecentViews::find(std::size_t view, std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find_if(kept_, [&](const Kept& kept) {
    return kept.view && kept.view->index == view && kept.number == number;
  });
  return found == kept_.end() ? nullptr : found->view;
}

template <class Is>
void RecentViews::release_if(const Is& is) {
  std::array<ViewPtr, kMost> released;
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < kMost; ++i) {
    if (kept_[i].view && is(*kept_[i].view)) std::swap(released[i], kept_[i].view);
  }
}

void RecentViews::release_unwanted(hal::TimePoint now) {
  release_if([&](const View& view) { return !wants(view.index, now); });
}

void RecentViews::release_all() {
  release_if([](const View&) { return true; });
}

}  // namespace orbwatch::app::web
