// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/shift_search.h"

#include <opencv2/imgproc.hpp>

namespace orbwatch::align {
namespace {

using optics::Outline;
using optics::Vec2;

constexpr int kCandidates = 4;
/// Distance, share of the radius, below which two peaks count as one.
constexpr double kApart = 0.05;
/// Share of the outline's radius that moves with the limb.
constexpr double kBall = 1.03;

/// The slopes' directions as unit vectors (32FC2); shorter ones for weak slopes.
cv::Mat directions(const cv::Mat& picture) {
  cv::Mat along_u, along_v, strength;
  cv::Sobel(picture, along_u, CV_32F, 1, 0);
  cv::Sobel(picture, along_v, CV_32F, 0, 1);
  cv::magnitude(along_u, along_v, strength);
  strength += 0.3 * cv::mean(strength)[0] + 1e-6;
  cv::divide(along_u, strength, along_u);
  cv::divide(along_v, strength, along_v);
  cv::Mat both;
  cv::merge(std::vector<cv::Mat>{along_u, along_v}, both);
  return both;
}

cv::Mat spectrum_of(const cv::Mat& slopes, const cv::Size& padded) {
  cv::Mat wide(padded, CV_32FC2, cv::Scalar::all(0)), spectrum;
  slopes.copyTo(wide(cv::Rect({0, 0}, slopes.size())));
  cv::dft(wide, spectrum, 0, slopes.rows);
  return spectrum;
}

}  // namespace

ShiftSearch::ShiftSearch(const cv::Mat& picture, const Outline& outline)
    : padded_(cv::getOptimalDFTSize(2 * picture.cols), cv::getOptimalDFTSize(2 * picture.rows)) {
  cv::Mat mask(picture.size(), CV_8U, cv::Scalar(0)), ball(picture.size(), CV_32FC2);
  ball = cv::Scalar::all(0);
  cv::ellipse(mask,
              cv::RotatedRect(cv::Point2d(outline.centre.u, outline.centre.v),
                              cv::Size2d(2 * kBall * outline.rx, 2 * kBall * outline.ry),
                              static_cast<float>(outline.angle)),
              cv::Scalar(255), cv::FILLED);
  directions(picture).copyTo(ball, mask);
  spectrum_ = spectrum_of(ball, padded_);
}

std::vector<Vec2> ShiftSearch::run(const cv::Mat& picture) const {
  cv::Mat product, likeness, real;
  cv::mulSpectrums(spectrum_of(directions(picture), padded_), spectrum_, product, 0, true);
  cv::dft(product, likeness, cv::DFT_INVERSE);
  cv::extractChannel(likeness, real, 0);
  std::vector<Vec2> shifts;
  const int apart = std::max(2, static_cast<int>(kApart * picture.cols));
  for (int n = 0; n < kCandidates; ++n) {
    cv::Point peak;
    cv::minMaxLoc(real, nullptr, nullptr, nullptr, &peak);
    shifts.push_back(
        {static_cast<double>(peak.x > padded_.width / 2 ? peak.x - padded_.width : peak.x),
         static_cast<double>(peak.y > padded_.height / 2 ? peak.y - padded_.height : peak.y)});
    cv::circle(real, peak, apart, cv::Scalar(-1e30), cv::FILLED);
  }
  return shifts;
}

}  // namespace orbwatch::align
