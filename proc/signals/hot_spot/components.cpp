// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/components.h"

#include <iterator>
#include <utility>

namespace orbwatch::signals {

void Components::reserve(const RegionMask& mask) {
  make_room(runs_, mask.most_runs());
  make_room(next_, mask.most_runs());
  make_room(totals_, mask.most_runs());
  edges_.reserve(mask.right() - mask.left());
  size_ = count_ = 0;
}

template <class T>
void Components::find(const ImageView<const T>& values,
                      const ImageView<const std::uint8_t>& validity, double threshold,
                      const RegionMask& mask) {
  const NoSums none;
  Joiner joiner(runs_);
  if (const auto least = count_at_least<T>(threshold)) {
    for (const Span& span : mask.spans()) {
      joiner.begin_row(span.y);
      edges_.for_each_run(values.row(span.y), validity.row(span.y), span, *least,
                          [&](int begin, int end) {
                            joiner.add({span.y, begin, end}, none);
                          });
    }
  }
  finish(joiner.size());
}

template <class T>
void Components::find(const ImageView<const T>& values,
                      const ImageView<const std::uint8_t>& validity, double threshold,
                      const Components& lower) {
  const NoSums none;
  Joiner joiner(runs_);
  if (const auto least = count_at_least<T>(threshold)) {
    for (const Run& run : lower.runs()) {
      const int y = run.span.y;
      joiner.begin_row(y);
      edges_.for_each_run(values.row(y), validity.row(y), run.span, *least,
                          [&](int begin, int end) {
                            joiner.add({y, begin, end}, none);
                          });
    }
  }
  finish(joiner.size());
}

/// A run's component is its own index or an earlier one, whose own is final.
void Components::finish(std::size_t size) {
  size_ = size;
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < size; ++i) {
    Run& run = runs_[i];
    const int pixels = run.span.end - run.span.begin;
    next_[i] = i;
    if (run.component == i) {
      totals_[i] = {pixels, i};
      ++count;
      continue;
    }
    run.component = runs_[run.component].component;
    Total& total = totals_[run.component];
    total.pixels += pixels;
    totals_[i].pixels = 0;
    next_[total.last] = i;
    total.last = i;
  }
  count_ = count;
}

std::size_t Components::at(int x, int y) const {
  const auto all = runs();
  const auto after = std::ranges::upper_bound(all, std::pair(y, x), {}, [](const Run& run) {
    return std::pair(run.span.y, run.span.begin);
  });
  if (after == all.begin()) return kNone;
  const Run& run = *std::prev(after);
  return run.span.y == y && x < run.span.end ? run.component : kNone;
}

#define ORBWATCH_FIND_COMPONENTS(T)                                                               \
  template void Components::find(const ImageView<const T>&, const ImageView<const std::uint8_t>&, \
                                 double, const RegionMask&);                                      \
  template void Components::find(const ImageView<const T>&, const ImageView<const std::uint8_t>&, \
                                 double, const Components&)
ORBWATCH_FIND_COMPONENTS(std::uint8_t);
ORBWATCH_FIND_COMPONENTS(std::uint16_t);

}  // namespace orbwatch::signals
