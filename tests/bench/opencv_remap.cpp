// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/opencv_remap.h"

#include <opencv2/imgproc.hpp>

#include "tests/bench/opencv_header.h"

namespace orbwatch::bench {
namespace {

/// The map in cv::remap's fast form; pixels without a place get one outside of the picture.
OpencvRemap::Maps maps_of(const Rig& rig, int divisor) {
  cv::Mat map(rig.named.height / divisor, rig.named.width / divisor, CV_32FC2, cv::Scalar(-1, -1));
  auto* next = map.ptr<cv::Vec2f>();
  for (const auto& place : rig.exact_map(divisor)) {
    if (place) *next = {static_cast<float>(place->u), static_cast<float>(place->v)};
    ++next;
  }
  OpencvRemap::Maps maps;
  cv::convertMaps(map, cv::Mat(), maps.places, maps.weights, CV_16SC2);
  return maps;
}

}  // namespace

bool OpencvRemap::takes(PixelFormat format) {
  return format != PixelFormat::Yuyv && format != PixelFormat::Uyvy;
}

OpencvRemap::OpencvRemap(const Rig& rig, const Frame& source)
    : output_(Frame::blank(source.format, rig.named.width, rig.named.height)) {
  cv::setNumThreads(1);
  for (std::size_t n = 0; n < source.planes.size(); ++n) {
    const int divisor = 1 << info(source.format).planes[n].shift_x;
    passes_.push_back(
        {header_of(source.planes[n]), header_of(output_.planes[n]), maps_of(rig, divisor)});
  }
}

void OpencvRemap::run() {
  for (Pass& pass : passes_) {
    cv::remap(pass.source, pass.output, pass.maps.places, pass.maps.weights, cv::INTER_LINEAR);
  }
}

}  // namespace orbwatch::bench
