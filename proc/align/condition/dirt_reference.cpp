// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/dirt_reference.h"

#include <opencv2/core.hpp>
#include <string>

namespace orbwatch::align {

Result<> check_reference(const DirtReference& reference) {
  for (const auto member : SmallMarks::maps()) {
    const cv::Mat& map = reference.*member;
    if (map.type() == CV_8U && map.size() == cv::Size(kRasterSide, kRasterSide)) continue;
    return fail("a map of the clean ball is " + std::to_string(map.cols) + "x" +
                std::to_string(map.rows) + "; all must have " + std::to_string(kRasterSide) + "x" +
                std::to_string(kRasterSide) + " bytes");
  }
  return {};
}

DirtReference joined(const DirtReference& a, const DirtReference& b) {
  DirtReference both;
  both.detail = a.detail.clone();
  both.around = a.around.clone();
  cv::max(a.dark, b.dark, both.dark);
  cv::max(a.bright, b.bright, both.bright);
  // Places that only one reference judged keep that one's values.
  b.detail.copyTo(both.detail, a.judged == 0);
  b.around.copyTo(both.around, a.judged == 0);
  cv::max(a.judged, b.judged, both.judged);
  return both;
}

}  // namespace orbwatch::align
