// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/small_lights.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "proc/align/detect/picture/luminance.h"

namespace orbwatch::align {
namespace {

constexpr double kWidest = 1.0 / 12;   // share of the ball's radius
constexpr double kLimb = 0.95;         // share of the radius; everything beyond is narrow
constexpr double kShareOfPeak = 0.25;  // share of the brightest one, per pixel
constexpr double kMeans = 12;  // multiple of the small details' mean that a light must exceed

/// The ball's part of a picture of that size.
cv::Rect part_of(const optics::Outline& outline, const cv::Size& size) {
  const int reach = static_cast<int>(std::ceil(std::max(outline.rx, outline.ry)));
  const cv::Point centre(static_cast<int>(std::lround(outline.centre.u)),
                         static_cast<int>(std::lround(outline.centre.v)));
  const cv::Rect ball(centre.x - reach, centre.y - reach, 2 * reach + 1, 2 * reach + 1);
  return ball & cv::Rect({0, 0}, size);
}

Result<cv::Mat> mean_of(std::span<const Picture> pictures, const cv::Rect& part) {
  cv::Mat sum(part.size(), CV_32F, cv::Scalar(0));
  for (const Picture& picture : pictures) {
    if (picture.width != pictures.front().width || picture.height != pictures.front().height) {
      return fail("the pictures must be of one size");
    }
    cv::accumulate(luminance_of(picture)(part), sum);
  }
  return cv::Mat(sum / static_cast<double>(pictures.size()));
}

/// Brightness above all wide things nearby, on the ball.
cv::Mat small_light(const cv::Mat& mean, const optics::Outline& outline, const cv::Point& corner) {
  const int side = 2 * static_cast<int>(std::ceil(kWidest * mean_radius(outline))) + 3;
  cv::Mat small;
  cv::morphologyEx(mean, small, cv::MORPH_TOPHAT,
                   cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  cv::Mat ball(mean.size(), CV_8U, cv::Scalar(0));
  const cv::Point2f centre(static_cast<float>(outline.centre.u - corner.x),
                           static_cast<float>(outline.centre.v - corner.y));
  const cv::Size2f axes(static_cast<float>(2 * kLimb * outline.rx),
                        static_cast<float>(2 * kLimb * outline.ry));
  cv::ellipse(ball, cv::RotatedRect(centre, axes, static_cast<float>(outline.angle)),
              cv::Scalar(255), cv::FILLED);
  small.setTo(0, ball == 0);
  return small;
}

/// Visits every pixel above the threshold with the number of its light, from 1.
template <class Visit>
void visit_lights(const cv::Mat& small, const cv::Mat& labels, const Visit& each) {
  for (int v = 0; v < small.rows; ++v) {
    for (int u = 0; u < small.cols; ++u) {
      const auto label = static_cast<std::size_t>(labels.at<int>(v, u));
      if (label > 0) each(label, u, v, double{small.at<float>(v, u)});
    }
  }
}

/// A light's centre is that of its brighter half: there may be something bright behind it.
std::vector<SmallLight> lights_above(const cv::Mat& small, double threshold,
                                     const cv::Point& corner) {
  cv::Mat labels;
  const int count = cv::connectedComponents(small > threshold, labels);
  std::vector<SmallLight> lights(static_cast<std::size_t>(count));
  std::vector<double> sums(lights.size(), 0);
  visit_lights(small, labels, [&](std::size_t label, int, int, double value) {
    lights[label].brightness = std::max(lights[label].brightness, value);
  });
  visit_lights(small, labels, [&](std::size_t label, int u, int v, double value) {
    SmallLight& light = lights[label];
    const double weight = value - light.brightness / 2;
    if (weight <= 0) return;
    light.centre.u += weight * (u + corner.x);
    light.centre.v += weight * (v + corner.y);
    sums[label] += weight;
  });
  for (std::size_t n = 1; n < lights.size(); ++n) {
    lights[n].centre = {lights[n].centre.u / sums[n], lights[n].centre.v / sums[n]};
  }
  lights.erase(lights.begin());  // the background
  std::ranges::sort(lights, std::greater{}, &SmallLight::brightness);
  if (lights.size() > kMostSmallLights) lights.resize(kMostSmallLights);
  return lights;
}

}  // namespace

Result<std::vector<SmallLight>> small_lights(std::span<const Picture> pictures,
                                             const optics::Outline& outline) {
  if (pictures.empty()) return fail("there are no pictures");
  const cv::Rect part = part_of(outline, {pictures.front().width, pictures.front().height});
  if (part.empty()) return fail("the ball's outline lies outside of the picture");
  const auto mean = mean_of(pictures, part);
  if (!mean) return tl::unexpected(mean.error());
  const cv::Mat small = small_light(*mean, outline, part.tl());
  double peak = 0;
  cv::minMaxLoc(small, nullptr, &peak);
  if (peak < kMeans * cv::mean(small)[0] || peak < 1) {
    return fail("the ball shows no small bright light");
  }
  return lights_above(small, kShareOfPeak * peak, part.tl());
}

std::optional<optics::Vec2> moved_light(std::span<const SmallLight> here,
                                        std::span<const std::vector<SmallLight>> elsewhere,
                                        const optics::Outline& outline) {
  const double reach = std::max(2.0, mean_radius(outline) / 100);
  const auto stands = [&](const SmallLight& light) {
    return std::ranges::any_of(elsewhere, [&](const std::vector<SmallLight>& lights) {
      return std::ranges::any_of(lights, [&](const SmallLight& other) {
        return std::hypot(other.centre.u - light.centre.u, other.centre.v - light.centre.v) < reach;
      });
    });
  };
  const auto moved = std::ranges::find_if_not(here, stands);
  if (moved == here.end()) return std::nullopt;
  return moved->centre;
}

}  // namespace orbwatch::align
