// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/opencv_merge.h"

#include <opencv2/imgproc.hpp>

#include "tests/bench/opencv_header.h"

namespace orbwatch::bench {
namespace {

/// Weights in the form of blendLinear.
cv::Mat share_of(const MergedView& ours, std::size_t camera) {
  const int width = ours.view().width(), height = ours.view().height();
  cv::Mat weights(height, width, CV_8U), share;
  ours.blend().weights(camera, ours.cameras()[camera].grid,
                       {weights.data, width, height, 1, width});
  weights.convertTo(share, CV_32F, 1.0 / 255);
  return share;
}

}  // namespace

OpencvMerge::Source OpencvMerge::source_of(const MergedView& ours, std::size_t camera) {
  const auto& [frame, picture, ball, grid] = ours.cameras()[camera];
  Source source;
  for (const Plane& plane : frame.planes) source.planes.push_back(header_of(plane));
  if (source.planes.size() == 1) source.picture = source.planes[0];
  const optics::ViewProjection& view = ours.view();
  cv::Mat map(view.height(), view.width(), CV_32FC2);
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      const auto direction = view.direction(x, y);
      const auto place = direction ? ball.pixel(*direction) : std::nullopt;
      map.at<cv::Vec2f>(y, x) =
          place ? cv::Vec2f(static_cast<float>(place->u), static_cast<float>(place->v))
                : cv::Vec2f(-1, -1);
    }
  }
  cv::convertMaps(map, cv::Mat(), source.places, source.map_weights, CV_16SC2);
  source.share = share_of(ours, camera);
  if (info(frame.format).colour != ColourModel::Luminance) return source;
  const auto [table, low, high] = scale_of(frame.format);
  source.scale = 255 / (high - low);
  source.offset = -low * source.scale;
  source.colours.create(256, 1, CV_8UC3);
  for (int i = 0; i < 256; ++i) {
    const auto& [red, green, blue] = table[static_cast<std::size_t>(i)];
    source.colours.at<cv::Vec3b>(i) = {red, green, blue};
  }
  return source;
}

OpencvMerge::OpencvMerge(const MergedView& ours) {
  cv::setNumThreads(1);
  for (std::size_t n = 0; n < ours.cameras().size(); ++n) sources_.push_back(source_of(ours, n));
}

void OpencvMerge::show(Source& source) {
  if (source.planes.size() == 2) {
    cv::cvtColorTwoPlane(source.planes[0], source.planes[1], source.picture,
                         cv::COLOR_YUV2RGB_NV12);
  }
  const bool is_coloured = !source.colours.empty();
  cv::remap(source.picture, is_coloured ? source.sampled : source.shown, source.places,
            source.map_weights, cv::INTER_LINEAR);
  if (!is_coloured) return;
  const bool is_wide = source.sampled.depth() == CV_16U;
  if (is_wide) cv::convertScaleAbs(source.sampled, source.bytes, source.scale, source.offset);
  cv::applyColorMap(is_wide ? source.bytes : source.sampled, source.shown, source.colours);
}

void OpencvMerge::run() {
  for (Source& source : sources_) show(source);
  cv::blendLinear(sources_[0].shown, sources_[1].shown, sources_[0].share, sources_[1].share, out_);
}

}  // namespace orbwatch::bench
