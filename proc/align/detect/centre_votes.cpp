// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/centre_votes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace orbwatch::align {
namespace {

struct Reach {
  int nearest;
  int farthest;
};

constexpr int kStep = 2;  // px: votes are blurred by more than that

/// One vote per kStep along the line through (u, v) in direction (du, dv).
void vote(cv::Mat& votes, float u, float v, float du, float dv, const Reach& reach) {
  float x = u + 0.5F + du * static_cast<float>(reach.nearest);
  float y = v + 0.5F + dv * static_cast<float>(reach.nearest);
  du *= kStep;
  dv *= kStep;
  for (int at = reach.nearest; at <= reach.farthest; at += kStep, x += du, y += dv) {
    if (!(x >= 0 && y >= 0)) return;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    if (column >= votes.cols || row >= votes.rows) return;
    votes.at<float>(row, column) += 1;
  }
}

cv::Mat all_votes(const Slopes& slopes, const Reach& reach) {
  // Neighbours in a large picture are redundant.
  const int apart = std::max(slopes.width(), slopes.height()) > 300 ? 2 : 1;
  const float firm = 4 * slopes.floor2;
  cv::Mat votes(slopes.along_u.size(), CV_32F, cv::Scalar(0));
  for (int v = 1; v < votes.rows - 1; ++v) {
    for (int u = 1 + v % apart; u < votes.cols - 1; u += apart) {
      const float gu = slopes.along_u.at<float>(v, u), gv = slopes.along_v.at<float>(v, u);
      const float squared = gu * gu + gv * gv;
      if (squared < firm) continue;
      const float scale = 1 / std::sqrt(squared);
      const auto x = static_cast<float>(u), y = static_cast<float>(v);
      vote(votes, x, y, gu * scale, gv * scale, reach);
      vote(votes, x, y, -gu * scale, -gv * scale, reach);
    }
  }
  return votes;
}

}  // namespace

std::vector<optics::Vec2> centre_votes(const Slopes& slopes, double nearest, double farthest,
                                       std::size_t most) {
  cv::Mat votes = all_votes(slopes, {static_cast<int>(nearest), static_cast<int>(farthest)});
  // A slope's direction is accurate to some degrees.
  cv::GaussianBlur(votes, votes, {}, std::max(1.5, 0.04 * farthest));
  std::vector<optics::Vec2> places;
  while (places.size() < most) {
    double best = 0;
    cv::Point place;
    cv::minMaxLoc(votes, nullptr, &best, nullptr, &place);
    if (!(best > 0)) break;
    places.push_back({static_cast<double>(place.x), static_cast<double>(place.y)});
    cv::circle(votes, place, static_cast<int>(0.4 * nearest) + 1, cv::Scalar(0), cv::FILLED);
  }
  return places;
}

}  // namespace orbwatch::align
