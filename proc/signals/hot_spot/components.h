// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "proc/image/image_view.h"
#include "proc/image/untouched_memory.h"
#include "proc/signals/hot_spot/edges.h"
#include "proc/signals/region.h"

namespace orbwatch::signals {

/// A run of pixels in a row that belongs to a component.
struct Run {
  Span span;
  std::uint32_t component = 0;  ///< index of the component's first run
};

/// Connected components (8 neighbours) of a region's pixels at or above a threshold, with their
/// number of pixels; LevelSet measures them. Allocates only in reserve(). Thread-bound.
class Components {
 public:
  Components() = default;
  explicit Components(const RegionMask& mask) { reserve(mask); }

  /// Makes room for any components of the region; those found before are lost.
  void reserve(const RegionMask& mask);

  /// Finds components among the values that are Validity::Seen.
  template <class T>
  void find(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
            double threshold, const RegionMask& mask);

  /// The same within all components of a lower threshold of the same picture.
  template <class T>
  void find(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
            double threshold, const Components& lower);

  /// The same within one of them; and sums.add(run, span) for each run before it is joined,
  /// sums.join(kept, joined) for each two components that become one.
  template <class T, class Sums>
  void find(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
            double threshold, const Components& lower, std::size_t component, Sums&& sums);
  template <class T>
  void find(const ImageView<const T>& values, const ImageView<const std::uint8_t>& validity,
            double threshold, const Components& lower, std::size_t component) {
    find(values, validity, threshold, lower, component, NoSums());
  }

  /// Runs of all components, by row, then from left to right.
  std::span<const Run> runs() const { return {runs_.data(), size_}; }

  /// Calls visit(span) for a component's runs, in the same order.
  template <class Visit>
  void for_each_span(std::size_t component, const Visit& visit) const {
    for (std::size_t run = component;; run = next_[run]) {
      visit(runs_[run].span);
      if (next_[run] == run) return;
    }
  }

  /// Number of components. They are identified by their first run.
  std::size_t count() const { return count_; }

  /// Pixels of the component that begins with that run; 0 when none does.
  int pixels(std::size_t run) const { return totals_[run].pixels; }

  /// The component of a pixel; kNone when it belongs to none.
  std::size_t at(int x, int y) const;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

 private:
  /// Totals of a component; no pixels for a run that is not the first of one.
  struct Total {
    int pixels;
    std::uint32_t last;  ///< last run
  };
  struct NoSums {
    void add(std::size_t, const Span&) const {}
    void join(std::size_t, std::size_t) const {}
  };
  class Joiner;

  void finish(std::size_t size);

  // Capacity is for the worst noise; nearly all of it is never touched.
  UntouchedVector<Run> runs_;  ///< the first `size_` are used
  /// For each run, the component's next one; the last one's is itself.
  UntouchedVector<std::uint32_t> next_;
  UntouchedVector<Total> totals_;  ///< for each run
  EdgeFinder edges_{0};
  std::size_t size_ = 0;
  std::size_t count_ = 0;
};

/// Adds runs by row, then from left to right, and joins each with those above. Diagonal neighbours
/// count: runs touch when they overlap by one pixel more on either side.
class Components::Joiner {
 public:
  explicit Joiner(UntouchedVector<Run>& runs)
      : runs_(runs.data()), end_(runs_), row_begin_(runs_), above_(runs_) {}

  std::size_t size() const { return size_; }

  void begin_row(int y) {
    if (y == row_) return;
    above_ = y == row_ + 1 ? row_begin_ : end_;
    row_begin_ = end_;
    row_ = y;
  }

  template <class Sums>
  [[gnu::always_inline]] void add(const Span& span, Sums& sums) {
    sums.add(size_, span);
    std::uint32_t component = size_;
    Run* const above_end = row_begin_;
    Run* above = above_;
    while (above != above_end && above->span.end < span.begin) ++above;
    above_ = above;
    for (; above != above_end && above->span.begin <= span.end; ++above) {
      const std::uint32_t other = root(above->component);
      if (other == component) continue;
      const auto [kept, joined] = std::minmax(component, other);
      sums.join(kept, joined);
      runs_[joined].component = kept;  // this run's own is written last
      component = kept;
    }
    *end_++ = {span, component};
    ++size_;
  }

 private:
  std::uint32_t root(std::uint32_t run) {
    while (runs_[run].component != run) {
      run = runs_[run].component = runs_[runs_[run].component].component;
    }
    return run;
  }

  Run* runs_;
  Run* end_;
  std::uint32_t size_ = 0;
  int row_ = -2;    ///< the row being filled; at first no row, nor the one above
  Run* row_begin_;  ///< its first run, which is the end of the row above
  Run* above_;      ///< the first run above that can touch the next one
};

template <class T, class Sums>
void Components::find(const ImageView<const T>& values,
                      const ImageView<const std::uint8_t>& validity, double threshold,
                      const Components& lower, std::size_t component, Sums&& sums) {
  Joiner joiner(runs_);
  if (const auto least = count_at_least<T>(threshold)) {
    lower.for_each_span(component, [&](const Span& span) {
      joiner.begin_row(span.y);
      edges_.for_each_run(values.row(span.y), validity.row(span.y), span, *least,
                          [&](int begin, int end) {
                            joiner.add({span.y, begin, end}, sums);
                          });
    });
  }
  finish(joiner.size());
}

}  // namespace orbwatch::signals
