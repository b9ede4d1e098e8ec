// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/blob_pixels.h"

namespace orbwatch::signals {
namespace {

struct Point {
  double u, v;
};

/// Corners, at most 8: two of a square's four sides contribute two each, plus its own four.
struct Polygon {
  std::array<Point, 8> corners;
  std::size_t size = 0;

  void add(double u, double v) { corners[size++] = {u, v}; }
};

Polygon border_of(const std::array<double, 4>& above) {
  constexpr std::array<Point, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  Polygon polygon;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    const double here = above[i], there = above[next];
    const Point &a = kCorners[i], &b = kCorners[next];
    if (here >= 0) polygon.add(a.u, a.v);
    if ((here >= 0) == (there >= 0)) continue;
    const double share = here / (here - there);
    polygon.add(a.u + share * (b.u - a.u), a.v + share * (b.v - a.v));
  }
  return polygon;
}

}  // namespace

// Moments of a polygon by Green's theorem (Bourke: Calculating the area and centroid of a polygon,
// 1988), with the second moments by the same method.
Piece piece_above(const std::array<double, 4>& above) {
  const Polygon polygon = border_of(above);
  double area = 0, u = 0, v = 0, uu = 0, vv = 0, uv = 0;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Point& a = polygon.corners[i];
    const Point& b = polygon.corners[(i + 1) % polygon.size];
    const double twice = a.u * b.v - b.u * a.v;
    area += twice / 2;
    u += twice * (a.u + b.u) / 6;
    v += twice * (a.v + b.v) / 6;
    uu += twice * (a.u * a.u + a.u * b.u + b.u * b.u) / 12;
    vv += twice * (a.v * a.v + a.v * b.v + b.v * b.v) / 12;
    uv += twice * (2 * a.u * a.v + a.u * b.v + b.u * a.v + 2 * b.u * b.v) / 24;
  }
  // A corner exactly at the threshold covers no area.
  constexpr double kNothing = 1e-12;
  if (!(area > kNothing)) return {0, 0.5, 0.5, 0, 0, 0};
  u /= area;
  v /= area;
  return {area, u, v, uu / area - u * u, vv / area - v * v, uv / area - u * v};
}

BlobPixels::BlobPixels(const RegionMask& mask)
    : left_(mask.left()),
      right_(mask.right()),
      top_(mask.top()),
      bottom_(mask.bottom()),
      stride_(static_cast<std::size_t>(mask.right() - mask.left()) + 2),
      state_(stride_ * (static_cast<std::size_t>(mask.bottom() - mask.top()) + 2)) {
  for (const Span& span : mask.spans()) {
    for (int x = span.begin; x < span.end; ++x) state_[index(x, span.y)] = kInRegion;
  }
  spans_.reserve(mask.most_runs());
}

void BlobPixels::assign(const Components& components, std::size_t component) {
  clear();
  if (component == Components::kNone) return;
  components.for_each_span(component, [&](const Span& span) { add(span); });
}

void BlobPixels::assign(const BlobPixels& other) {
  clear();
  for (const Span& span : other.spans_) add(span);
}

void BlobPixels::add(const Span& span) {
  first_x_ = spans_.empty() ? span.begin : std::min(first_x_, span.begin);
  last_x_ = spans_.empty() ? span.end - 1 : std::max(last_x_, span.end - 1);
  spans_.push_back(span);
  mark(span, true);
}

void BlobPixels::clear() {
  for (const Span& span : spans_) mark(span, false);
  spans_.clear();
}

void BlobPixels::mark(const Span& span, bool member) {
  const auto state = static_cast<std::uint8_t>(member ? kInRegion | kMember : kInRegion);
  std::fill_n(&state_[index(span.begin, span.y)], span.end - span.begin, state);
}

}  // namespace orbwatch::signals
