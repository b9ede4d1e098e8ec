// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace orbwatch::remap {

/// Pixels of a source picture: columns [left, right) of rows [top, bottom).
struct SourceArea {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  constexpr bool is_empty() const { return left >= right || top >= bottom; }
  friend constexpr bool operator==(const SourceArea&, const SourceArea&) = default;
};

/// The smallest area that holds both.
constexpr SourceArea united(const SourceArea& a, const SourceArea& b) {
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

/// The intersection of both.
constexpr SourceArea common(const SourceArea& a, const SourceArea& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
          std::min(a.bottom, b.bottom)};
}

/// Calls `visit` with at most four areas that together are `whole` without `part`, which lies
/// within it.
template <class Visit>
void for_each_rest(const SourceArea& whole, const SourceArea& part, const Visit& visit) {
  const auto visit_any = [&](const SourceArea& area) {
    if (!area.is_empty()) visit(area);
  };
  if (part.is_empty()) return visit_any(whole);
  visit_any({whole.left, whole.top, whole.right, part.top});
  visit_any({whole.left, part.top, part.left, part.bottom});
  visit_any({part.right, part.top, whole.right, part.bottom});
  visit_any({whole.left, part.bottom, whole.right, whole.bottom});
}

}  // namespace orbwatch::remap
