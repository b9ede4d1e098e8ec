// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/ball_crop.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "proc/align/detect/picture/luminance.h"
#include "proc/align/limb_distance.h"

namespace orbwatch::align {
namespace {

constexpr int kMarginAround = 16;     // px around the ball, needed by edges on the limb
constexpr double kDarkShare = 0.02;   // share of full scale that a tenth of the pixels must reach
constexpr double kDarkNoise = 6;      // multiple of the noise that they must reach
constexpr double kOverexposed = 0.5;  // share of pixels at full scale
constexpr double kJudgedRho = 0.95;   // the light within it counts
constexpr int kSampledRows = 256;

cv::Rect bounds(const optics::Outline& outline) {
  const double turn = optics::radians(outline.angle), c = std::cos(turn), s = std::sin(turn);
  const double half_u = std::hypot(outline.rx * c, outline.ry * s) + kMarginAround;
  const double half_v = std::hypot(outline.rx * s, outline.ry * c) + kMarginAround;
  const cv::Point low(cvFloor(outline.centre.u - half_u), cvFloor(outline.centre.v - half_v));
  const cv::Point high(cvCeil(outline.centre.u + half_u), cvCeil(outline.centre.v + half_v));
  return {low, high};
}

double quantile(std::vector<float>& values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return static_cast<double>(*place);
}

/// J. Immerkaer, Fast noise variance estimation, 1996: the residual of a picture without its planes
/// and edges; by the median, because reflections are full of edges.
double noise_of(const cv::Mat& brightness) {
  std::vector<float> magnitudes, column(static_cast<std::size_t>(brightness.cols));
  const int step = std::max(1, brightness.rows / kSampledRows);
  for (int v = 1; v + 2 < brightness.rows; v += 3 * step) {
    const float* const above = brightness.ptr<float>(v - 1);
    const float* const here = brightness.ptr<float>(v);
    const float* const below = brightness.ptr<float>(v + 1);
    for (std::size_t u = 0; u < column.size(); ++u) column[u] = above[u] - 2 * here[u] + below[u];
    for (std::size_t u = 1; u + 1 < column.size(); ++u) {
      magnitudes.push_back(std::abs(column[u - 1] - 2 * column[u] + column[u + 1]));
    }
  }
  if (magnitudes.empty()) return 0;
  return quantile(magnitudes, 0.5) / 0.6745 / 6;
}

/// Reason why a ball in this light cannot be judged; else empty.
std::string bad_light(const BallCrop& crop) {
  std::vector<float> inside;
  const LimbDistance distance(crop.outline);
  const int step = std::max(1, crop.brightness.rows / kSampledRows);
  for (int v = 0; v < crop.brightness.rows; v += step) {
    const float* const row = crop.brightness.ptr<float>(v);
    for (int u = 0; u < crop.brightness.cols; u += step) {
      const double rho2 = distance.squared({u - crop.outline.centre.u, v - crop.outline.centre.v});
      if (rho2 < kJudgedRho * kJudgedRho) inside.push_back(row[u]);
    }
  }
  if (inside.empty()) return "the picture shows nothing of the ball";
  const double bright = quantile(inside, 0.9);
  if (bright < std::max(kDarkShare * crop.full_scale, kDarkNoise * crop.noise)) {
    return "the ball's picture is dark; light or a longer exposure is needed";
  }
  if (quantile(inside, 1 - kOverexposed) >= 0.98 * crop.full_scale) {
    return "the ball's picture is overexposed; a shorter exposure is needed";
  }
  return "";
}

}  // namespace

double BallCrop::rho(double u, double v) const {
  return LimbDistance(outline).of({u - outline.centre.u, v - outline.centre.v});
}

Result<BallCrop> crop_ball(const Picture& picture, const optics::Outline& outline, int halvings) {
  const bool is_larger = std::max(outline.rx, outline.ry) > picture.width + picture.height;
  const cv::Rect wanted = is_larger ? cv::Rect() : bounds(outline);
  const cv::Rect seen = wanted & cv::Rect(0, 0, picture.width, picture.height);
  if (seen.empty() || seen.area() < wanted.area() / 2) {
    return fail("the picture shows less than half of the ball; it must show most of it");
  }
  BallCrop crop;
  crop.brightness = luminance_of(picture, seen);
  crop.outline = outline;
  crop.outline.centre = {outline.centre.u - seen.x, outline.centre.v - seen.y};
  for (int n = 0; n < halvings; ++n) crop = halved(crop);
  crop.brightness.convertTo(crop.brightness, CV_32F);
  crop.full_scale = std::exp2(info(picture.format).bits) - 1;
  crop.noise = noise_of(crop.brightness);
  const std::string reason = bad_light(crop);
  if (!reason.empty()) return fail(reason);
  return crop;
}

BallCrop halved(const BallCrop& crop) {
  BallCrop half = crop;
  const cv::Rect even(0, 0, crop.brightness.cols / 2 * 2, crop.brightness.rows / 2 * 2);
  cv::resize(crop.brightness(even), half.brightness, {}, 0.5, 0.5, cv::INTER_AREA);
  half.outline.centre = {(crop.outline.centre.u - 0.5) / 2, (crop.outline.centre.v - 0.5) / 2};
  half.outline.rx = crop.outline.rx / 2;
  half.outline.ry = crop.outline.ry / 2;
  half.noise = crop.noise / 2;
  return half;
}

}  // namespace orbwatch::align
