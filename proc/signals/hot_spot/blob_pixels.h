// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/signals/hot_spot/components.h"
#include "proc/signals/region.h"

namespace orbwatch::signals {

/// The part of a unit square that is above a threshold.
struct Piece {
  double area = 1;
  // Centroid, from the square's upper left corner: u right, v down.
  double u = 0.5;
  double v = 0.5;
  // Variances and covariance.
  double uu = 1.0 / 12;
  double vv = 1.0 / 12;
  double uv = 0;
};

/// The piece between four neighbouring pixels whose counts exceed the threshold by `above`
/// (negative below it): upper left, upper right, lower right, lower left. The border is straight
/// between its intersections with the sides, which are interpolated linearly: one square of the
/// marching squares (Lorensen, Cline: Marching cubes, 1987, in the plane). Two opposite corners are
/// joined. At least one corner is not negative.
Piece piece_above(const std::array<double, 4>& above);

/// Four neighbouring pixels, or four times the same one: upper left, upper right, lower right,
/// lower left.
struct Corners {
  int x = 0;  ///< column of the upper left
  int y = 0;
  bool square = true;  ///< true for four pixels
  std::array<const PixelGeometry*, 4> geometry{};
  std::array<double, 4> counts{};
};

/// The value at a place with these bilinear weights.
inline double mean_of(const std::array<double, 4>& weights, const std::array<double, 4>& values) {
  return weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2] +
         weights[3] * values[3];
}

/// Offsets from the upper left corner to each of the four, in their order.
inline constexpr std::array<std::array<int, 2>, 4> kCornerOffsets{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// The bilinear weights of a square's corners at a place in it.
inline std::array<double, 4> corner_weights(double u, double v) {
  return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
}

inline bool is_seen(const ImageView<const std::uint8_t>& validity, int x, int y) {
  return *validity.at(x, y) == static_cast<std::uint8_t>(Validity::Seen);
}

/// The pixels of one blob, and the area that they cover. Allocates only at construction.
/// Thread-bound.
class BlobPixels {
 public:
  explicit BlobPixels(const RegionMask& mask);

  /// Replaces the pixels by those of that component; none for Components::kNone.
  void assign(const Components& components, std::size_t component);
  /// Copies `other`, of the same region.
  void assign(const BlobPixels& other);
  void clear();

  bool contains(int x, int y) const { return (state_[index(x, y)] & kMember) != 0; }

  /// Runs of the blob, sorted by row.
  std::span<const Span> spans() const { return spans_; }
  bool empty() const { return spans_.empty(); }

  // The bounding box of its pixels and of their neighbours in the region's bounding box: columns
  // [left, right), rows [top, bottom). Not defined for an empty one.
  int left() const { return std::max(first_x_ - 1, left_); }
  int right() const { return std::min(last_x_ + 2, right_); }
  int top() const { return std::max(spans_.front().y - 1, top_); }
  int bottom() const { return std::min(spans_.back().y + 2, bottom_); }

  /// Cuts the blob into pieces, each within a square between four pixel centres: whole squares, and
  /// along its border the part above `threshold`, the blob's. At the border of the region or of the
  /// seen pixels, pixels count by quarters. Calls visit(piece, corners).
  template <class T, class Visit>
  void for_each_piece(const ImageView<const T>& values,
                      const ImageView<const std::uint8_t>& validity, double threshold,
                      const RegionGeometry& geometry, const Visit& visit) const;

 private:
  static constexpr std::uint8_t kInRegion = 1;
  static constexpr std::uint8_t kMember = 2;

  /// Index with a border of one pixel around the region's bounding box.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - top_ + 1) * stride_ +
           static_cast<std::size_t>(x - left_ + 1);
  }
  void add(const Span& span);
  void mark(const Span& span, bool member);
  template <class Visit>
  static void visit_quarters(const std::array<std::uint8_t, 4>& state, const Corners& corners,
                             const Visit& visit);

  // The region's bounding box.
  int left_;
  int right_;
  int top_;
  int bottom_;
  std::size_t stride_;
  std::vector<std::uint8_t> state_;
  std::vector<Span> spans_;
  int first_x_ = 0;  ///< bounding box of the spans
  int last_x_ = 0;
};

template <class T, class Visit>
void BlobPixels::for_each_piece(const ImageView<const T>& values,
                                const ImageView<const std::uint8_t>& validity, double threshold,
                                const RegionGeometry& geometry, const Visit& visit) const {
  if (spans_.empty()) return;
  for (int y = spans_.front().y - 1; y <= spans_.back().y; ++y) {
    const std::uint8_t* upper = &state_[index(first_x_ - 1, y)];
    const std::uint8_t* lower = upper + stride_;
    for (int x = first_x_ - 1; x <= last_x_; ++x, ++upper, ++lower) {
      const std::array<std::uint8_t, 4> state{upper[0], upper[1], lower[1], lower[0]};
      if (((state[0] | state[1] | state[2] | state[3]) & kMember) == 0) continue;
      const bool whole = (state[0] & state[1] & state[2] & state[3] & kMember) != 0;
      Corners corners{.x = x, .y = y};
      for (std::size_t i = 0; i < 4; ++i) {
        const int u = x + kCornerOffsets[i][0], v = y + kCornerOffsets[i][1];
        if ((state[i] & kInRegion) == 0 || !is_seen(validity, u, v)) {
          corners.square = false;
          continue;
        }
        corners.geometry[i] = &geometry.at(u, v);
        corners.counts[i] = *values.at(u, v);
      }
      if (!corners.square) {
        visit_quarters(state, corners, visit);
      } else if (whole) {
        visit(Piece{}, corners);
      } else {
        const auto& c = corners.counts;
        const Piece piece =
            piece_above({c[0] - threshold, c[1] - threshold, c[2] - threshold, c[3] - threshold});
        if (piece.area > 0) visit(piece, corners);
      }
    }
  }
}

template <class Visit>
void BlobPixels::visit_quarters(const std::array<std::uint8_t, 4>& state, const Corners& corners,
                                const Visit& visit) {
  for (std::size_t i = 0; i < 4; ++i) {
    if ((state[i] & kMember) == 0) continue;
    Corners pixel = corners;
    pixel.geometry.fill(corners.geometry[i]);
    pixel.counts.fill(corners.counts[i]);
    visit(Piece{.area = 0.25}, pixel);
  }
}

}  // namespace orbwatch::signals
