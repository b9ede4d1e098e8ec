// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/picture/pyramid.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace orbwatch::align {

Pyramid::Pyramid(const cv::Mat& luminance) : levels_{luminance} {
  while (std::max(levels_.back().cols, levels_.back().rows) >= 2 * kSmallest) {
    // An odd last row or column is left out, so that scales are powers of two.
    const cv::Mat& last = levels_.back();
    const cv::Size half(last.cols / 2, last.rows / 2);
    if (half.empty()) return;
    cv::Mat smaller;
    cv::resize(last(cv::Rect(0, 0, 2 * half.width, 2 * half.height)), smaller, half, 0, 0,
               cv::INTER_AREA);
    levels_.push_back(smaller);
  }
}

std::size_t Pyramid::level_for(const optics::Outline& outline, double radius) const {
  std::size_t n = 0;
  for (double r = outline.rx; n + 1 < size() && r > 1.5 * radius; r /= 2) ++n;
  return n;
}

optics::Outline Pyramid::between(const optics::Outline& outline, std::size_t from, std::size_t to) {
  const double f = std::ldexp(1.0, static_cast<int>(from) - static_cast<int>(to));
  return {{(outline.centre.u + 0.5) * f - 0.5, (outline.centre.v + 0.5) * f - 0.5},
          outline.rx * f,
          outline.ry * f,
          outline.angle};
}

}  // namespace orbwatch::align
