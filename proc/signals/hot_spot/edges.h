// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/signals/region.h"

namespace orbwatch::signals {

/// The least count at or above `threshold`; nullopt: T has none.
template <class T>
std::optional<T> count_at_least(double threshold) {
  const double count = std::ceil(std::max(threshold, 0.0));
  if (!(count <= std::numeric_limits<T>::max())) return std::nullopt;
  return static_cast<T>(count);
}

/// Finds in a row the runs of pixels that are at or above a count and Validity::Seen. Allocates
/// only in reserve(). Thread-bound.
class EdgeFinder {
 public:
  explicit EdgeFinder(int widest) { reserve(widest); }

  /// `widest`: most pixels of a span.
  void reserve(int widest) {
    edges_.resize(std::max(edges_.size(), static_cast<std::size_t>(widest) + 1));
  }

  /// Calls visit(begin, end) for each run within `span`, from left to right. `values` and
  /// `validity`: the span's rows; values beyond the span are not read.
  template <class T, class Visit>
  void for_each_run(const T* values, const std::uint8_t* validity, const Span& span, T least,
                    const Visit& visit) {
    const int* const end = span.end - span.begin < kBlock
                               ? find_one_by_one(values, validity, span, least, edges_.data())
                               : find_by_blocks(values, validity, span, least, edges_.data());
    for (const int* edge = edges_.data(); edge != end; edge += 2) visit(edge[0], edge[1]);
  }

 private:
  static constexpr int kBlock = 64;

  /// Both write first pixel and end of each run alternately, and return the end of the written
  /// edges.
  template <class T>
  static int* find_one_by_one(const T* values, const std::uint8_t* validity, const Span& span,
                              T least, int* edges) {
    bool is_inside = false;
    for (int x = span.begin; x < span.end; ++x) {
      const bool is_hot =
          values[x] >= least && validity[x] == static_cast<std::uint8_t>(Validity::Seen);
      if (is_hot != is_inside) *edges++ = x;
      is_inside = is_hot;
    }
    if (is_inside) *edges++ = span.end;
    return edges;
  }
  template <class T>
  static int* find_by_blocks(const T* values, const std::uint8_t* validity, const Span& span,
                             T least, int* edges);

  std::vector<int> edges_;
};

}  // namespace orbwatch::signals
