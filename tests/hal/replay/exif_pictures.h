// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace orbwatch::tests {

inline std::vector<std::byte> jpeg_of(const cv::Mat& image) {
  std::vector<unsigned char> jpeg;
  EXPECT_TRUE(cv::imencode(".jpg", image, jpeg));
  const auto* first = reinterpret_cast<const std::byte*>(jpeg.data());
  return {first, first + jpeg.size()};
}

/// Picture of 32x16, the left half bright, with segments after its start.
inline std::vector<std::byte> jpeg_with(const std::string& segments) {
  cv::Mat image(16, 32, CV_8UC1, cv::Scalar(0));
  image(cv::Rect(0, 0, 16, 16)).setTo(255);
  auto jpeg = jpeg_of(image);
  const auto* bytes = reinterpret_cast<const std::byte*>(segments.data());
  jpeg.insert(jpeg.begin() + 2, bytes, bytes + segments.size());
  return jpeg;
}

inline std::string app1(const std::string& content) {
  const std::size_t length = content.size() + 2;
  return "\xff\xe1" + std::string{static_cast<char>(length >> 8), static_cast<char>(length)} +
         content;
}

/// TIFF header and one entry: 0x0112 Orientation, SHORT, count 1.
inline std::string exif(char orientation) {
  return app1(std::string("Exif\0\0", 6) + std::string("MM\0\x2a\0\0\0\x08\0\x01", 10) +
              std::string("\x01\x12\0\x03\0\0\0\x01\0", 9) + orientation +
              std::string("\0\0\0\0\0\0", 6));
}

}  // namespace orbwatch::tests
