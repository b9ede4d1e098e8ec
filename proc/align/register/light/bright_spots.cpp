// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/light/bright_spots.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "proc/align/detect/picture/luminance.h"
#include "proc/align/limb_distance.h"

namespace orbwatch::align {
namespace {

constexpr std::size_t kMostForMedian = 15;
constexpr double kNoises = 10;         // standard deviations of the background
constexpr double kShareOfPeak = 0.15;  // share of the brightest change in the whole sequence
constexpr double kLimbMargin = 2;      // px around the limb, so that a spot on it is whole

/// Pictures as 16 bit, so that one pixel type suffices.
std::vector<cv::Mat> luminances(std::span<const Picture> pictures) {
  std::vector<cv::Mat> all;
  for (const Picture& picture : pictures) {
    cv::Mat wide;
    luminance_of(picture).convertTo(wide, CV_16U);
    all.push_back(wide);
  }
  return all;
}

/// The median per pixel, from some pictures spread over the sequence.
cv::Mat median_picture(const std::vector<cv::Mat>& pictures) {
  const std::size_t step = (pictures.size() + kMostForMedian - 1) / kMostForMedian;
  cv::Mat middle(pictures.front().size(), CV_16U);
  std::vector<std::uint16_t> samples;
  for (int v = 0; v < middle.rows; ++v) {
    for (int u = 0; u < middle.cols; ++u) {
      samples.clear();
      for (std::size_t n = 0; n < pictures.size(); n += step) {
        samples.push_back(pictures[n].at<std::uint16_t>(v, u));
      }
      const auto at = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
      std::nth_element(samples.begin(), at, samples.end());
      middle.at<std::uint16_t>(v, u) = *at;
    }
  }
  return middle;
}

/// 255 within the limb, or everywhere without one.
cv::Mat mask_of_ball(const std::optional<optics::Outline>& limb, const cv::Size& size) {
  if (!limb) return cv::Mat(size, CV_8U, cv::Scalar(255));
  const LimbDistance distance(
      {limb->centre, limb->rx + kLimbMargin, limb->ry + kLimbMargin, limb->angle});
  cv::Mat mask(size, CV_8U);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const bool is_ball = distance.squared({u - limb->centre.u, v - limb->centre.v}) <= 1;
      mask.at<std::uint8_t>(v, u) = is_ball ? 255 : 0;
    }
  }
  return mask;
}

std::vector<BrightSpot> spots(const cv::Mat& change, double threshold) {
  cv::Mat bright, labels, stats, centres;
  cv::compare(change, cv::Scalar(threshold), bright, cv::CMP_GT);
  const int count = cv::connectedComponentsWithStats(bright, labels, stats, centres);
  struct Sum {
    double light = 0, u = 0, v = 0;
  };
  std::vector<Sum> sums(static_cast<std::size_t>(count));
  for (int v = 0; v < change.rows; ++v) {
    for (int u = 0; u < change.cols; ++u) {
      const double light = change.at<std::uint16_t>(v, u);
      Sum& sum = sums[static_cast<std::size_t>(labels.at<int>(v, u))];
      sum.light += light;
      sum.u += light * u;
      sum.v += light * v;
    }
  }
  std::vector<BrightSpot> found;
  for (std::size_t n = 1; n < sums.size(); ++n) {
    const Sum& sum = sums[n];
    found.push_back({{sum.u / sum.light, sum.v / sum.light}, sum.light});
  }
  std::ranges::sort(found, std::greater{}, &BrightSpot::light);
  if (found.size() > kMostSpots) found.resize(kMostSpots);
  return found;
}

}  // namespace

Result<std::vector<std::vector<BrightSpot>>> bright_spots(
    std::span<const Picture> pictures, const std::optional<optics::Outline>& limb) {
  if (pictures.size() < kLeastPictures) {
    return fail("a sequence of " + std::to_string(pictures.size()) + " pictures is too short, " +
                std::to_string(kLeastPictures) + " are needed");
  }
  for (const Picture& picture : pictures) {
    if (picture.width != pictures.front().width || picture.height != pictures.front().height) {
      return fail("the pictures of a sequence must be of one size");
    }
  }
  const std::vector<cv::Mat> all = luminances(pictures);
  const cv::Mat background = median_picture(all);
  const cv::Mat ball = mask_of_ball(limb, background.size()), elsewhere = ~ball;
  std::vector<cv::Mat> changes;
  double peak = 0, noise = 1;
  for (const cv::Mat& picture : all) {
    cv::Mat brighter;
    cv::subtract(picture, background, brighter);
    brighter.setTo(0, elsewhere);
    double highest = 0;
    cv::minMaxLoc(brighter, nullptr, &highest);
    peak = std::max(peak, highest);
    // Half of all pixels are darker than the median: the mean of the rest is 0.4 sigma.
    noise = std::max(noise, cv::mean(cv::min(brighter, 50), ball)[0] / 0.4);
    changes.push_back(brighter);
  }
  std::vector<std::vector<BrightSpot>> found;
  found.reserve(changes.size());
  for (const cv::Mat& change : changes) {
    found.push_back(spots(change, std::max(kNoises * noise, kShareOfPeak * peak)));
  }
  return found;
}

}  // namespace orbwatch::align
