// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/received_image.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "hal/atomic_file.h"
#include "hal/jpeg/jpeg_decoder.h"

namespace orbwatch::app::cli {
namespace {

void swap_bytes(cv::Mat& words) {
  for (int y = 0; y < words.rows; ++y) {
    auto* row = words.ptr<std::uint16_t>(y);
    std::transform(row, row + words.cols, row, [](std::uint16_t word) {
      return static_cast<std::uint16_t>(word << 8 | word >> 8);
    });
  }
}

/// The image in OpenCV's layout: blue first, the host's byte order.
cv::Mat to_mat(const ReceivedImage& image) {
  const int type = CV_MAKETYPE(image.encoding.bytes_per_sample == 2 ? CV_16U : CV_8U,
                               static_cast<int>(image.encoding.channels));
  const cv::Mat received(static_cast<int>(image.height), static_cast<int>(image.width), type,
                         const_cast<std::uint8_t*>(image.data), image.step);
  cv::Mat result;
  if (image.encoding.name == dds::kRgb8.name) {
    cv::cvtColor(received, result, cv::COLOR_RGB2BGR);
  } else {
    received.copyTo(result);
  }
  if (image.swapped) swap_bytes(result);
  return result;
}

/// Saves the image that `make_image` returns; it may throw OpenCV's exceptions.
template <class MakeImage>
Result<> save(MakeImage make_image, const std::filesystem::path& path) try {
  std::vector<std::uint8_t> png;
  if (!cv::imencode(".png", make_image(), png)) return fail("image: cannot be encoded as PNG");
  return hal::write_file(path, png);
} catch (const cv::Exception& error) {
  return fail("image: cannot be encoded as PNG: " + error.err);
}

}  // namespace

Result<ReceivedImage> check_image(const dds::ImageMessage& message) {
  const auto encoding = std::ranges::find(dds::kImageEncodings, std::string_view(message.encoding),
                                          &dds::ImageEncoding::name);
  // The message does not quote the sender, whose text may contain control characters.
  if (encoding == dds::kImageEncodings.end()) {
    return fail("image: encoding is none of rgb8, bgr8, mono8, mono16");
  }
  const std::uint32_t width = message.width;
  const std::uint32_t height = message.height;
  if (const auto checked = check_image_size(width, height); !checked) {
    return tl::unexpected(checked.error());
  }
  if (message.step < width * encoding->bytes_per_pixel()) {
    return fail("image: step of " + std::to_string(message.step) + " bytes, a row needs " +
                std::to_string(width * encoding->bytes_per_pixel()));
  }
  if (message.step % encoding->bytes_per_sample != 0) {
    return fail("image: step of " + std::to_string(message.step) + " bytes, samples have " +
                std::to_string(encoding->bytes_per_sample));
  }
  const std::uint64_t size = std::uint64_t{message.step} * height;
  if (message.data._length != size) {
    return fail("image: " + std::to_string(message.data._length) +
                " bytes of data, step and height say " + std::to_string(size));
  }
  return ReceivedImage{
      *encoding,
      width,
      height,
      message.step,
      message.data._buffer,
      encoding->bytes_per_sample > 1 && (message.is_bigendian != 0) != dds::kBigEndianHost};
}

Result<> check_image_size(std::uint32_t width, std::uint32_t height) {
  if (width > 0 && height > 0 && width <= kMaxImageSide && height <= kMaxImageSide) return {};
  return fail("image: " + std::to_string(width) + " x " + std::to_string(height) +
              " pixels, each side must be 1 to " + std::to_string(kMaxImageSide));
}

Result<> save_png(const ReceivedImage& image, const std::filesystem::path& path) {
  return save([&image] { return to_mat(image); }, path);
}

Result<> save_jpeg_as_png(std::span<const std::uint8_t> jpeg, const std::filesystem::path& path) {
  // OpenCV decodes damaged pictures without an error.
  hal::JpegDecoder strict;
  if (const auto checked = strict.check(std::as_bytes(jpeg)); !checked) return checked;
  const cv::Mat bytes(1, static_cast<int>(jpeg.size()), CV_8UC1,
                      const_cast<std::uint8_t*>(jpeg.data()));
  return save([&bytes] { return cv::imdecode(bytes, cv::IMREAD_UNCHANGED); }, path);
}

}  // namespace orbwatch::app::cli
