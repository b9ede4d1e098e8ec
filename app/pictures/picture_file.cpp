// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/picture_file.h"

#include <algorithm>
#include <cctype>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "hal/atomic_file.h"
#include "proc/align/first_plane.h"
#include "proc/image/image_view.h"

namespace orbwatch::app {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Converts to OpenCV's order of channels.
cv::Mat to_bgr(const Picture& picture) {
  const cv::Mat rgb = align::first_plane(picture);
  if (rgb.channels() == 1) return rgb;
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

cv::Mat with_alpha(const cv::Mat& picture, const ImageView<const std::uint8_t>& validity) {
  cv::Mat bgra;
  cv::cvtColor(picture, bgra, picture.channels() == 1 ? cv::COLOR_GRAY2BGRA : cv::COLOR_BGR2BGRA);
  const cv::Mat seen(validity.height, validity.width, CV_8U,
                     const_cast<std::uint8_t*>(validity.data),
                     static_cast<std::size_t>(validity.stride));
  cv::Mat alpha;
  cv::Mat(seen == static_cast<int>(Validity::Seen))
      .convertTo(alpha, bgra.depth(), bgra.depth() == CV_16U ? 257 : 1);
  cv::insertChannel(alpha, bgra, 3);
  return bgra;
}

}  // namespace

Result<> check_picture_name(const std::filesystem::path& path, PixelFormat format,
                            bool transparency) {
  const std::string extension = lower_extension(path);
  if (extension == ".png") return {};
  if (extension != ".jpg" && extension != ".jpeg") {
    return fail(path.string() +
                ": unknown kind of picture; its name must end in .png, .jpg or .jpeg");
  }
  if (transparency) return fail(path.string() + ": JPEG has no transparency; write a .png");
  if (info(format).bytes_per_sample() == 2) {
    return fail(path.string() + ": JPEG has 8 bits, the picture has 16; write a .png");
  }
  return {};
}

Result<> write_picture(const std::filesystem::path& path, const Picture& picture,
                       const ImageView<const std::uint8_t>& validity) {
  if (auto named = check_picture_name(path, picture.format, !validity.empty()); !named)
    return named;
  std::vector<std::uint8_t> bytes;
  try {
    const cv::Mat bgr = to_bgr(picture);
    const cv::Mat encoded = validity.empty() ? bgr : with_alpha(bgr, validity);
    const bool jpeg = lower_extension(path) != ".png";
    const std::vector<int> options =
        jpeg ? std::vector<int>{cv::IMWRITE_JPEG_QUALITY, 95} : std::vector<int>{};
    if (!cv::imencode(jpeg ? ".jpg" : ".png", encoded, bytes, options)) {
      return fail(path.string() + ": the picture cannot be encoded");
    }
  } catch (const cv::Exception& error) {
    return fail(path.string() + ": the picture cannot be encoded: " + error.err);
  }
  return hal::write_file(path, bytes);
}

}  // namespace orbwatch::app
