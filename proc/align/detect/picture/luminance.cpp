// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/picture/luminance.h"

#include <opencv2/imgproc.hpp>

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
  switch (picture.format) {
    case PixelFormat::Yuyv:
      return channel(samples, 0);
    case PixelFormat::Uyvy:
      return channel(samples, 1);
    case PixelFormat::Rgb:
    case PixelFormat::Rgb16:
      return grey(samples, cv::COLOR_RGB2GRAY);
    case PixelFormat::Bgr:
      return grey(samples, cv::COLOR_BGR2GRAY);
    case PixelFormat::Bgra:
      return grey(samples, cv::COLOR_BGRA2GRAY);
    case PixelFormat::Grey:
    case PixelFormat::Y10:
    case PixelFormat::Y12:
    case PixelFormat::Y16:
    case PixelFormat::Nv12:
    case PixelFormat::Nv21:
    case PixelFormat::I420:
      break;
  }
  return samples;
}

}  // namespace orbwatch::align
