// SPDX-License-Identifier: Apache-2.0
#include "hal/mosaic/demosaic.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

namespace orbwatch::hal {
namespace {

int conversion(Mosaic mosaic) {
  switch (mosaic) {
    case Mosaic::Rggb:
      return cv::COLOR_BayerRGGB2BGR;
    case Mosaic::Grbg:
      return cv::COLOR_BayerGRBG2BGR;
    case Mosaic::Gbrg:
      return cv::COLOR_BayerGBRG2BGR;
    case Mosaic::Bggr:
      return cv::COLOR_BayerBGGR2BGR;
    case Mosaic::None:
      break;
  }
  return -1;
}

cv::Mat pixels(const ImageView<const std::uint8_t>& view, int type) {
  // OpenCV has no read-only view.
  return {view.height, view.width, type, const_cast<std::uint8_t*>(view.data),
          static_cast<std::size_t>(view.stride)};
}

}  // namespace

Result<> demosaic(Mosaic mosaic, const ImageView<const std::uint8_t>& samples,
                  const ImageView<std::uint8_t>& bgr) {
  if (mosaic == Mosaic::None || std::min(samples.width, samples.height) < 4 ||
      samples.width != bgr.width || samples.height != bgr.height) {
    return fail("no mosaic of " + std::to_string(bgr.width) + "x" + std::to_string(bgr.height) +
                " pixels, at least 4x4");
  }
  try {
    cv::Mat colours = pixels(bgr, CV_8UC3);
    cv::demosaicing(pixels(samples, CV_8UC1), colours, conversion(mosaic));
    return {};
  } catch (const cv::Exception& error) {
    return fail("cannot be demosaiced: " + error.err);
  }
}

}  // namespace orbwatch::hal
