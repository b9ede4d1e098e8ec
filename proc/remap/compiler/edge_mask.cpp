// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/compiler/edge_mask.h"

#include <algorithm>
#include <cmath>

#include "proc/remap/grid/coordinate.h"

namespace orbwatch::remap {
namespace {

using optics::Vec2;
using optics::Vec3;

// Lengths in radians of an edge's segments, which are tested at their ends and middle.
constexpr double kLongPiece = 0.2;
constexpr double kShortPiece = 1e-5;
// Tolerance in pixels of a segment against the straight line that is drawn for it.
constexpr double kStraight = 0.05;

double distance(const Vec2& a, const Vec2& b) { return std::hypot(b.u - a.u, b.v - a.v); }

/// True if `middle` lies between the ends on their straight line.
bool is_straight(const Vec2& from, const Vec2& middle, const Vec2& to) {
  const double length = distance(from, to);
  const double area = (to.u - from.u) * (middle.v - from.v) - (to.v - from.v) * (middle.u - from.u);
  return std::abs(area) <= kStraight * length && distance(from, middle) <= length &&
         distance(middle, to) <= length;
}

/// Calls `mark(k, low, high)` for the integers k in [0, size) that a line's coordinate `a` reaches
/// or misses by at most kStraight, with the range of its coordinate `b` there, widened by
/// kStraight.
template <class Mark>
void cross_lines(double a0, double b0, double a1, double b1, int size, const Mark& mark) {
  if (a0 > a1) std::swap(a0, a1), std::swap(b0, b1);
  if (!(a1 > -1 && a0 < size)) return;
  const double slope = a1 > a0 ? (b1 - b0) / (a1 - a0) : 0;
  const int first = static_cast<int>(std::max(0.0, std::ceil(a0 - kStraight)));
  const int last = static_cast<int>(std::min(size - 1.0, std::floor(a1 + kStraight)));
  for (int k = first; k <= last; ++k) {
    const double from = std::max(a0, k - kStraight), to = std::min(a1, k + kStraight);
    // The ends of a line along `k` do not follow from a slope.
    const bool along = a1 - a0 <= 2 * kStraight;
    const double start = along ? b0 : b0 + (from - a0) * slope;
    const double end = along ? b1 : b0 + (to - a0) * slope;
    mark(k, std::min(start, end) - kStraight, std::max(start, end) + kStraight);
  }
}

/// Follows edges through a view.
class Tracer {
 public:
  Tracer(const optics::ViewProjection& view, EdgeMask& mask) : view_(view), mask_(mask) {
    const double width = view_.width(), height = view_.height();
    const auto middle = view_.direction((width - 1) / 2, (height - 1) / 2);
    if (!middle) return;
    ahead_ = *middle;
    // The direction furthest from the middle is on the border, unless it is straight behind.
    constexpr int kSamples = 16;
    double furthest = 0;
    for (int i = 0; i <= kSamples; ++i) {
      const double u = width * i / kSamples - 0.5, v = height * i / kSamples - 0.5;
      for (const Vec2& border : {Vec2{u, -0.5}, {u, height - 0.5}, {-0.5, v}, {width - 0.5, v}}) {
        const auto direction = view_.direction(border.u, border.v);
        furthest = std::max(furthest, direction ? norm(*direction - ahead_) : 2);
      }
    }
    constexpr double kBetweenSamples = 0.05;
    radius_ = furthest + kBetweenSamples;
  }

  void trace(const Vec3& from, const Vec3& to) {
    trace(from, view_.pixel(from), to, view_.pixel(to));
  }

 private:
  using Place = std::optional<Vec2>;

  void trace(const Vec3& from, const Place& at_from, const Vec3& to, const Place& at_to) {
    const double length = norm(to - from);
    const Vec3 middle = normalized(from + to);
    if (norm(middle - ahead_) > radius_ + norm(from - middle)) return;
    const Place at_middle = view_.pixel(middle);
    if (length < kLongPiece) {
      if (!at_from && !at_middle && !at_to) return;
      if (at_from && at_middle && at_to && is_straight(*at_from, *at_middle, *at_to)) {
        mask_.mark(*at_from, *at_to);
        return;
      }
      if (length < kShortPiece) {
        // The edge jumps from border to border, or the projection ends in between.
        if (at_from) mask_.mark(*at_from, *at_from);
        if (at_to) mask_.mark(*at_to, *at_to);
        return;
      }
    }
    trace(from, at_from, middle, at_middle);
    trace(middle, at_middle, to, at_to);
  }

  const optics::ViewProjection& view_;
  EdgeMask& mask_;
  Vec3 ahead_;
  double radius_ = 2;  ///< no direction of the view is further from `ahead_`, as unit vectors
};

}  // namespace

EdgeMask::EdgeMask(int width, int height)
    : width_(width), height_(height), tiles_x_((width + kTile - 1) / kTile) {}

void EdgeMask::mark(const Vec2& from, const Vec2& to) {
  if (crossed_.empty()) {
    crossed_.resize(tile(0, (height_ + kTile - 1) / kTile));
    rows_.resize(crossed_.size() * kTile);
  }
  cross_lines(from.v, from.u, to.v, to.u, height_,
              [this](int y, double left, double right) { mark_row(y, left, right); });
  cross_lines(from.u, from.v, to.u, to.v, width_,
              [this](int x, double top, double bottom) { mark_column(x, top, bottom); });
}

/// An edge that meets row `y` between `left` and `right` may separate pixels x - 1 and x if x - 1
/// is left of `right` and x right of `left`.
void EdgeMask::mark_row(int y, double left, double right) {
  if (!(right > 0 && left < width_ - 1)) return;
  const int first = static_cast<int>(std::max(left, 0.0)) + 1;
  const int last = static_cast<int>(std::min(right, width_ - 2.0)) + 1;
  for (int x = first; x <= last; ++x) {
    rows_[static_cast<std::size_t>(y) * tiles_x_ + x / kTile] |=
        static_cast<std::uint16_t>(1U << (x % kTile));
    if (x % kTile != 0) crossed_[tile(x / kTile, y / kTile)] = 1;
  }
}

/// The same for column `x`: marks tiles that contain both of two pixels, one above the other, that
/// the edge may separate.
void EdgeMask::mark_column(int x, double top, double bottom) {
  if (!(bottom > 0 && top < height_ - 1)) return;
  const int first = static_cast<int>(std::max(top, 0.0)) + 1;
  const int last = static_cast<int>(std::min(bottom, height_ - 2.0)) + 1;
  for (int y = first; y <= last; ++y) {
    if (y % kTile != 0) crossed_[tile(x / kTile, y / kTile)] = 1;
  }
}

EdgeMask edge_mask(const optics::ViewProjection& view,
                   const std::vector<std::pair<Vec3, Vec3>>& edges) {
  EdgeMask mask(view.width(), view.height());
  if (edges.empty()) return mask;
  Tracer tracer(view, mask);
  for (const auto& [a, b] : edges) tracer.trace(normalized(a), normalized(b));
  return mask;
}

}  // namespace orbwatch::remap
