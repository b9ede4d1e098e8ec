// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/colour_maps.h"

#include <cassert>
#include <opencv2/imgproc.hpp>

namespace orbwatch::app {

remap::ColourMap::Table colour_map_table(std::string_view name) {
  struct Named {
    std::string_view name;
    int code;
  };
  constexpr std::array kMaps{Named{"inferno", cv::COLORMAP_INFERNO},
                             Named{"turbo", cv::COLORMAP_TURBO}, Named{"hot", cv::COLORMAP_HOT},
                             Named{"viridis", cv::COLORMAP_VIRIDIS}};
  static_assert(kMaps.size() + 1 == kColourMapNames.size());

  cv::Mat ramp(1, 256, CV_8U), bgr;
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::cvtColor(ramp, bgr, cv::COLOR_GRAY2BGR);
  for (const Named& map : kMaps) {
    if (map.name == name) cv::applyColorMap(ramp, bgr, map.code);
  }
  remap::ColourMap::Table table;
  for (int i = 0; i < 256; ++i) {
    const auto& pixel = bgr.at<cv::Vec3b>(0, i);
    table[static_cast<std::size_t>(i)] = {pixel[2], pixel[1], pixel[0]};
  }
  return table;
}

}  // namespace orbwatch::app
