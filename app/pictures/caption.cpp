// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/caption.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace orbwatch::app {
namespace {

constexpr int kLineHeight = 14, kMargin = 4, kColumnWidth = 400;  ///< px
constexpr double kFontScale = 0.8;
constexpr std::size_t kMostRows = 45;

std::string printable(std::string text) {
  text.resize(std::min(text.size(), Caption::kMostLength));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

std::size_t columns_for(int picture_width, std::size_t lines) {
  return std::max({std::size_t{1}, static_cast<std::size_t>(picture_width / kColumnWidth),
                   (lines + kMostRows - 1) / kMostRows});
}

}  // namespace

Caption::Caption(int picture_width, std::size_t lines) {
  const std::size_t columns = columns_for(picture_width, lines);
  width_ = std::max(picture_width, static_cast<int>(columns) * kColumnWidth);
  rows_ = std::max<std::size_t>(1, (lines + columns - 1) / columns);
}

int Caption::height() const { return static_cast<int>(rows_) * kLineHeight + 2 * kMargin; }

void Caption::draw(const std::vector<std::string>& lines,
                   const ImageView<std::uint8_t>& target) const {
  cv::Mat picture(target.height, target.width, CV_8UC(target.channels), target.data,
                  static_cast<std::size_t>(target.stride));
  picture.setTo(cv::Scalar::all(0));
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const cv::Point place(static_cast<int>(k / rows_) * kColumnWidth + kMargin,
                          (static_cast<int>(k % rows_) + 1) * kLineHeight);
    if (place.x + kColumnWidth > width_ + kMargin) return;
    cv::putText(picture, printable(lines[k]), place, cv::FONT_HERSHEY_PLAIN, kFontScale,
                cv::Scalar::all(255), 1, cv::LINE_AA);
  }
}

}  // namespace orbwatch::app
