// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/picture/luminance.h"

#include <opencv2/imgproc.hpp>

#include "proc/align/brightness_samples.h"
#include "proc/align/first_plane.h"

namespace orbwatch::align {
namespace {

cv::Mat channel(const cv::Mat& samples, int n) {
  cv::Mat one;
  cv::extractChannel(samples, one, n);
  return one;
}

cv::Mat grey(const cv::Mat& samples, int code) {
  cv::Mat one;
  cv::cvtColor(samples, one, code);
  return one;
}

}  // namespace

cv::Mat luminance_of(const Picture& picture) {
  return luminance_of(picture, {0, 0, picture.width, picture.height});
}

cv::Mat luminance_of(const Picture& picture, const cv::Rect& part) {
  const cv::Mat samples = first_plane(picture)(part);
  switch (brightness_samples(picture.format)) {
    case BrightnessSamples::First:
      return samples.channels() == 1 ? samples : channel(samples, 0);
    case BrightnessSamples::Second:
      return channel(samples, 1);
    case BrightnessSamples::RedGreenBlue:
      return grey(samples, cv::COLOR_RGB2GRAY);
    case BrightnessSamples::BlueGreenRed:
      return grey(samples, samples.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  }
  return samples;
}

}  // namespace orbwatch::align
