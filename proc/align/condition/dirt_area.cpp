// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/dirt_area.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace orbwatch::align {
namespace {

// Depth (255 = full) by which a mark must exceed the clean ball's marks.
constexpr int kShallowest = 30;
constexpr int kSmallest = 4;  // least area of a mark, px
// Difference (127 = full) from which on the surroundings count as changed.
constexpr int kOtherAround = 6;
constexpr int kChangeReach = 9;    // px around a change that are left out with it
constexpr double kSqueezed = 0.7;  // rho from which on reflections are recognised by their shape
constexpr double kSqueezeSlack = 1.4;
constexpr int kCell = 16;           // px; detail is compared cell by cell
constexpr double kLeastDetail = 4;  // least rms detail of a cell (127 = full)
constexpr int kFewestCells = 12;
constexpr double kSamePattern = 0.8;  // least correlation
constexpr double kWeaker = 0.7;       // most strength left, as a share

/// Depth of marks beyond that of the clean ball's, which may be a pixel off.
cv::Mat excess(const cv::Mat& usual, const cv::Mat& clean, const cv::Mat& judged) {
  cv::Mat around, more;
  cv::dilate(clean, around, cv::Mat::ones(3, 3, CV_8U));
  cv::subtract(usual, around, more);
  cv::Mat kept = cv::Mat::zeros(more.size(), CV_8U);
  more.copyTo(kept, judged);
  return kept;
}

/// Mask of pixels that are judged in both and whose surroundings have not changed.
cv::Mat judged_in_both(const SmallMarks& usual, const DirtReference& clean) {
  const cv::Mat judged = usual.judged & clean.judged;
  cv::Mat difference, around_change;
  cv::absdiff(usual.around, clean.around, difference);
  const cv::Mat changed = judged & (difference > kOtherAround);
  const int side = 2 * kChangeReach + 1;
  cv::dilate(changed, around_change, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}));
  return judged & ~around_change;
}

struct Mark {
  int area = 0;
  double u = 0, v = 0;            // sums, then means
  double uu = 0, uv = 0, vv = 0;  // likewise, about the mean

  void add(int x, int y) {
    ++area;
    u += x, v += y, uu += x * x, uv += x * y, vv += y * y;
  }
  void finish() {
    u /= area, v /= area;
    uu = uu / area - u * u + 1 / 12.0, uv = uv / area - u * v, vv = vv / area - v * v + 1 / 12.0;
  }
  /// True when its extent along the radius, relative to that across it, is at most that of the
  /// reflection of a round thing.
  bool is_reflected() const {
    const double middle = (kRasterSide - 1) / 2.0, x = u - middle, y = v - middle;
    const double rho = std::hypot(x, y) / kRasterRadius;
    if (rho < kSqueezed) return false;
    const double c = x / std::hypot(x, y), s = y / std::hypot(x, y);
    const double along = uu * c * c + 2 * uv * c * s + vv * s * s;
    const double across = uu * s * s - 2 * uv * c * s + vv * c * c;
    return std::sqrt(along / across) < kSqueezeSlack * (1 - rho * rho);
  }
};

/// Adds the marks of one kind to `sum`.
void add_marks(const cv::Mat& excess, DirtArea& sum) {
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(excess >= kShallowest, labels, stats, centres);
  for (int label = 1; label < count; ++label) {
    const int* const row = stats.ptr<int>(label);
    const cv::Rect box(row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH],
                       row[cv::CC_STAT_HEIGHT]);
    double deepest = 0;
    const cv::Mat own = labels(box) == label;
    cv::minMaxLoc(excess(box), nullptr, &deepest, nullptr, nullptr, own);
    Mark mark;
    for (int v = box.y; v < box.y + box.height; ++v) {
      for (int u = box.x; u < box.x + box.width; ++u) {
        if (labels.at<int>(v, u) == label && 3 * excess.at<std::uint8_t>(v, u) >= deepest) {
          mark.add(u, v);
        }
      }
    }
    mark.finish();
    if (mark.area < kSmallest || mark.is_reflected()) continue;
    sum.dirty += mark.area;
    sum.largest = std::max(sum.largest, mark.area);
  }
}

/// Comparison of one cell's detail before and now.
struct Comparison {
  int pixels = 0;
  double before2 = 0, now2 = 0, both = 0;

  bool has_detail() const {
    return pixels > kCell * kCell / 2 && before2 > kLeastDetail * kLeastDetail * pixels;
  }
  bool is_duller() const {
    return both > kSamePattern * std::sqrt(before2 * now2) && both < kWeaker * before2;
  }
};

Comparison compared(const SmallMarks& usual, const DirtReference& clean, const cv::Mat& judged,
                    int left, int top) {
  Comparison cell;
  for (int v = top; v < top + kCell; ++v) {
    for (int u = left; u < left + kCell; ++u) {
      if (judged.at<std::uint8_t>(v, u) == 0) continue;
      const double before = clean.detail.at<std::uint8_t>(v, u) - 128;
      const double now = usual.detail.at<std::uint8_t>(v, u) - 128;
      ++cell.pixels;
      cell.before2 += before * before;
      cell.now2 += now * now;
      cell.both += before * now;
    }
  }
  return cell;
}

}  // namespace

DirtArea dirt_area(const SmallMarks& usual, const DirtReference& clean) {
  const cv::Mat judged = judged_in_both(usual, clean);
  DirtArea sum;
  sum.judged = cv::countNonZero(judged);
  add_marks(excess(usual.dark, clean.dark, judged), sum);
  add_marks(excess(usual.bright, clean.bright, judged), sum);
  return sum;
}

double dulled_share(const SmallMarks& usual, const DirtReference& clean) {
  const cv::Mat judged = usual.judged & clean.judged;
  int cells = 0, duller = 0;
  for (int top = 0; top + kCell <= kRasterSide; top += kCell) {
    for (int left = 0; left + kCell <= kRasterSide; left += kCell) {
      const Comparison cell = compared(usual, clean, judged, left, top);
      if (!cell.has_detail()) continue;
      ++cells;
      duller += cell.is_duller() ? 1 : 0;
    }
  }
  return cells < kFewestCells ? 0 : static_cast<double>(duller) / cells;
}

}  // namespace orbwatch::align
