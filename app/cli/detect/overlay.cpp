// SPDX-License-Identifier: Apache-2.0
#include "app/cli/detect/overlay.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "app/pictures/picture_file.h"
#include "proc/align/detect/picture/luminance.h"
#include "proc/align/first_plane.h"

namespace orbwatch::app::cli {
namespace {

const cv::Scalar kColour(0, 255, 0);
constexpr int kShift = 4;  // fraction bits of OpenCV's coordinates

cv::Mat as_rgb(const Picture& picture) {
  const bool is_rgb = picture.format == PixelFormat::Rgb || picture.format == PixelFormat::Rgb16;
  cv::Mat rgb = (is_rgb ? align::first_plane(picture) : align::luminance_of(picture)).clone();
  if (rgb.depth() == CV_16U) cv::normalize(rgb, rgb, 0, 255, cv::NORM_MINMAX, CV_8U);
  if (rgb.channels() == 1) cv::cvtColor(rgb, rgb, cv::COLOR_GRAY2RGB);
  return rgb;
}

cv::Point fixed(double u, double v) {
  constexpr double kOne = 1 << kShift;
  return {cvRound(u * kOne), cvRound(v * kOne)};
}

}  // namespace

Result<> write_overlay(const std::filesystem::path& path, const Picture& picture,
                       const optics::Outline& outline) {
  cv::Mat rgb = as_rgb(picture);
  const int line = std::max(1, std::max(rgb.cols, rgb.rows) / 1000);
  const double arm = 0.05 * std::min(outline.rx, outline.ry);
  const auto [u, v] = outline.centre;
  cv::ellipse(rgb, fixed(u, v), cv::Size(fixed(outline.rx, outline.ry)), outline.angle, 0, 360,
              kColour, line, cv::LINE_AA, kShift);
  cv::line(rgb, fixed(u - arm, v), fixed(u + arm, v), kColour, line, cv::LINE_AA, kShift);
  cv::line(rgb, fixed(u, v - arm), fixed(u, v + arm), kColour, line, cv::LINE_AA, kShift);
  return write_picture(
      path,
      picture_of(PixelFormat::Rgb, ImageView<std::uint8_t>{rgb.data, rgb.cols, rgb.rows, 3,
                                                           static_cast<std::ptrdiff_t>(rgb.step)}));
}

}  // namespace orbwatch::app::cli
