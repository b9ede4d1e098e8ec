#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/vec.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::signals {

/// Pixels [begin, end) of row y.
struct Span {
  int y = 0;
  int begin = 0;
  int end = 0;
};

/// The pixels of a view that lie in a region, compiled once: whole rows are walked in the frame
/// path, never the polygon. Immutable; reentrant.
class RegionMask {
 public:
  /// Whether the measured camera sees a direction.
  using Sees = std::function<bool(const optics::Vec3&)>;

  /// `outline`: as in RegionSettings. A pixel belongs to the region when its centre does and the
  /// camera sees it; without `sees` it sees everything. Error: an outline that is no polygon, or
  /// without such a pixel.
  static Result<RegionMask> make(const optics::ViewProjection& view,
                                 std::span<const optics::Vec3> outline, const Sees& sees = nullptr);

  /// By row, then from left to right; pixels of the view.
  std::span<const Span> spans() const { return spans_; }

  /// Pixels of the region, and the most separate runs of them that there can be: every second one.
  std::size_t pixels() const { return pixels_; }
  std::size_t most_runs() const { return most_runs_; }

  // The bounding box of the spans: columns [left, right), rows [top, bottom).
  int left() const { return left_; }
  int right() const { return right_; }
  int top() const { return top_; }
  int bottom() const { return bottom_; }

 private:
  std::vector<Span> spans_;
  int left_ = 0;
  int right_ = 0;
  int top_ = 0;
  int bottom_ = 0;
  std::size_t pixels_ = 0;
  std::size_t most_runs_ = 0;
};

}  // namespace orbwatch::signals
