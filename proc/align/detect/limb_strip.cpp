#include "proc/align/detect/limb_strip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace orbwatch::align {
namespace {

constexpr int kWrapped = 4;   // rays around the ring that filters reach
constexpr float kMargin = 2;  // px of the picture's border that filters spoil

/// Where the strip's samples are in the picture.
struct Maps {
  cv::Mat u, v;
};

Maps maps_of(const optics::Outline& outline, double reach, int rays, int columns) {
  Maps maps{cv::Mat(rays, columns, CV_32F), cv::Mat(rays, columns, CV_32F)};
  const double turn = optics::radians(outline.angle), ct = std::cos(turn), st = std::sin(turn);
  for (int ray = 0; ray < rays; ++ray) {
    const double angle = 2 * std::numbers::pi * ray / rays;
    const double c = std::cos(angle), s = std::sin(angle);
    const double length = std::hypot(outline.ry * c, outline.rx * s);
    const double nx = outline.ry * c / length, ny = outline.rx * s / length;
    for (int k = 0; k < columns; ++k) {
      const double t = static_cast<double>(k) / LimbStrip::kPerPixel - reach;
      const double x = outline.rx * c + nx * t, y = outline.ry * s + ny * t;
      maps.u.at<float>(ray, k) = static_cast<float>(outline.centre.u + x * ct - y * st);
      maps.v.at<float>(ray, k) = static_cast<float>(outline.centre.v + x * st + y * ct);
    }
  }
  return maps;
}

}  // namespace

LimbStrip::LimbStrip(const cv::Mat& luminance, const optics::Outline& outline, double reach) {
  const double girth = std::numbers::pi * (outline.rx + outline.ry);
  const int rays = std::clamp(static_cast<int>(girth / 1.5), 128, 2048) / kTogether * kTogether;
  const int steps = static_cast<int>(reach * kPerPixel);
  const Maps maps = maps_of(outline, static_cast<double>(steps) / kPerPixel, rays, 2 * steps + 1);
  cv::Mat ring;
  cv::remap(luminance, ring, maps.u, maps.v, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
  ring.convertTo(ring, CV_32F);
  cv::copyMakeBorder(ring, ring, kWrapped, kWrapped, 0, 0, cv::BORDER_WRAP);
  cv::GaussianBlur(ring, ring, {}, 0.7 * kPerPixel, 0.7);
  cv::Mat along, across;
  cv::Scharr(ring, along, CV_32F, 1, 0, kPerPixel / 32.0);
  cv::Scharr(ring, across, CV_32F, 0, 1, rays / (32.0 * girth));
  along_ = along.rowRange(kWrapped, kWrapped + rays);
  across_ = across.rowRange(kWrapped, kWrapped + rays);
  const cv::Mat beyond = (maps.u < kMargin) | (maps.v < kMargin) |
                         (maps.u > static_cast<float>(luminance.cols - 1) - kMargin) |
                         (maps.v > static_cast<float>(luminance.rows - 1) - kMargin);
  along_.setTo(std::numeric_limits<float>::quiet_NaN(), beyond);
  floor2_ = measured_floor2();
}

float LimbStrip::measured_floor2() const {
  std::vector<float> sample;
  for (int ray = 0; ray < rays(); ray += 5) {
    for (int k = 0; k < columns(); k += 3) {
      if (const auto here = slope(ray, k)) sample.push_back(here->energy());
    }
  }
  if (sample.empty()) return 1;
  const auto third = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 3);
  std::nth_element(sample.begin(), third, sample.end());
  return std::max(*third * 0.3F, 1e-4F);
}

}  // namespace orbwatch::align
