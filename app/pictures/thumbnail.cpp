// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/thumbnail.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "app/pictures/picture_conversion.h"

namespace orbwatch::app {

Picture Thumbnail::of(const Picture& picture) {
  const bool is_grey = info(picture.format).colour == ColourModel::Luminance;
  const PixelFormat format = is_grey ? PixelFormat::Grey : PixelFormat::Rgb;
  const int longest = std::max(picture.width, picture.height),
            side = std::min(longest, kLongestSide);
  const int width = std::max(1, picture.width * side / longest);
  const int height = std::max(1, picture.height * side / longest);
  converted_.resize(packed_bytes(format, picture.width, picture.height));
  convert(picture, format, converted_.data());
  small_.resize(packed_bytes(format, width, height));
  const int type = is_grey ? CV_8UC1 : CV_8UC3;
  cv::Mat small(height, width, type, small_.data());
  cv::resize(cv::Mat(picture.height, picture.width, type, converted_.data()), small, small.size(),
             0, 0, cv::INTER_AREA);
  return Picture::contiguous(format, width, height, small_.data(), row_bytes(format, width));
}

}  // namespace orbwatch::app
