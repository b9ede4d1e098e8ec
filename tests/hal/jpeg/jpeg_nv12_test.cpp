// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "hal/jpeg/jpeg_decoder.h"
#include "tests/hal/jpeg/jpeg_marker.h"

namespace orbwatch::hal {
namespace {

constexpr int kPlanarWidth = 72;
constexpr int kPlanarHeight = 46;

/// Y, U and V at any point of the picture: smooth, so that any subsampling preserves them.
std::array<double, 3> truth(double x, double y) {
  return {40 + 2 * x + y, 220 - 2 * x, 30 + 3 * y};
}

struct Plane {
  std::vector<unsigned char> samples;
  int width = 0;
};

/// Component with the detail of a subsampling: each sample is the colour at its pixels' centre.
Plane plane(int component, int subsampling) {
  Plane made{{}, tjPlaneWidth(component, kPlanarWidth, subsampling)};
  const int height = tjPlaneHeight(component, kPlanarHeight, subsampling);
  const double columns = static_cast<double>(kPlanarWidth) / made.width;
  const double rows = static_cast<double>(kPlanarHeight) / height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < made.width; ++x) {
      const auto colour = truth((x + 0.5) * columns - 0.5, (y + 0.5) * rows - 0.5);
      made.samples.push_back(
          static_cast<unsigned char>(std::lround(colour[static_cast<std::size_t>(component)])));
    }
  }
  return made;
}

std::vector<std::byte> planar_jpeg(int subsampling, int flags = 0) {
  const int components = subsampling == TJSAMP_GRAY ? 1 : 3;
  std::vector<Plane> planes;
  std::array<const unsigned char*, 3> data{};
  std::array<int, 3> strides{};
  for (int n = 0; n < components; ++n) planes.push_back(plane(n, subsampling));
  for (std::size_t n = 0; n < planes.size(); ++n) {
    data[n] = planes[n].samples.data();
    strides[n] = planes[n].width;
  }
  tjhandle encoder = tjInitCompress();
  unsigned char* file = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(tjCompressFromYUVPlanes(encoder, data.data(), kPlanarWidth, strides.data(),
                                    kPlanarHeight, subsampling, &file, &size, 100, flags),
            0);
  const auto* first = reinterpret_cast<const std::byte*>(file);
  std::vector<std::byte> jpeg(first, first + size);
  tjFree(file);
  tjDestroy(encoder);
  return jpeg;
}

/// Nv12 picture with rows that are longer than the picture.
struct Nv12Target {
  static constexpr std::ptrdiff_t kStride = kPlanarWidth + 10;
  std::vector<std::byte> memory =
      std::vector<std::byte>(kStride * kPlanarHeight * 3 / 2, std::byte{0xee});
  MutablePicture picture = MutablePicture::contiguous(PixelFormat::Nv12, kPlanarWidth,
                                                      kPlanarHeight, memory.data(), kStride);

  int sample(std::size_t plane_number, int column, int row) const {
    const auto& p = picture.planes[plane_number];
    return std::to_integer<int>(p.data[row * p.stride + column]);
  }
};

class JpegNv12 : public testing::TestWithParam<int> {};

TEST_P(JpegNv12, HasTheLuminanceAndTheChromaThatWereCompressed) {
  JpegDecoder decoder;
  Nv12Target target;
  const auto done = decoder.decode_nv12(planar_jpeg(GetParam()), target.picture);
  ASSERT_TRUE(done) << done.error().message;
  const bool grey = GetParam() == TJSAMP_GRAY;
  // A sample for 4 columns is up to one column beside the pair's centre: 2 counts.
  const double chroma_tolerance = GetParam() == TJSAMP_411 ? 4 : 2;
  for (int y = 0; y < kPlanarHeight; ++y) {
    EXPECT_EQ(target.sample(0, kPlanarWidth, y), 0xee) << "wrote behind row " << y;
    EXPECT_EQ(target.sample(1, kPlanarWidth, y / 2), 0xee) << "wrote behind row " << y;
    for (int x = 0; x < kPlanarWidth; ++x) {
      ASSERT_NEAR(target.sample(0, x, y), truth(x, y)[0], 2) << x << ", " << y;
      const auto colour = truth(x - x % 2 + 0.5, y - y % 2 + 0.5);
      const std::size_t component = 1 + static_cast<std::size_t>(x % 2);
      ASSERT_NEAR(target.sample(1, x, y / 2), grey ? 128 : colour[component], chroma_tolerance)
          << x << ", " << y;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Subsampling, JpegNv12,
                         testing::Values(TJSAMP_444, TJSAMP_422, TJSAMP_420, TJSAMP_440, TJSAMP_411,
                                         TJSAMP_GRAY));

TEST(JpegNv12Damage, RefusesEveryTruncationOfItsData) {
  for (const int flags : {0, TJFLAG_PROGRESSIVE}) {
    const auto jpeg = planar_jpeg(TJSAMP_422, flags);
    JpegDecoder decoder;
    Nv12Target target;
    for (std::size_t length = 0; length < jpeg.size() - kMarkerBytes; length += 7) {
      ASSERT_FALSE(decoder.decode_nv12({jpeg.data(), length}, target.picture)) << length;
    }
    const auto done = decoder.decode_nv12(jpeg, target.picture);
    EXPECT_TRUE(done) << "must recover from errors: " << done.error().message;
  }
}

TEST(JpegNv12Damage, IsFoundAsByCheck) {
  const auto whole = planar_jpeg(TJSAMP_422);
  JpegDecoder decoder;
  Nv12Target target;
  int refused = 0;
  for (std::size_t at = 700; at < whole.size(); at += 3) {
    auto jpeg = whole;
    jpeg[at] ^= std::byte{0x55};
    const bool decoded = decoder.decode_nv12(jpeg, target.picture).has_value();
    EXPECT_EQ(decoder.check(jpeg).has_value(), decoded) << "byte " << at;
    refused += decoded ? 0 : 1;
  }
  EXPECT_GT(refused, 0);
}

TEST(JpegNv12Damage, RefusesAnotherSize) {
  JpegDecoder decoder;
  std::vector<std::byte> memory(64 * 46 * 3 / 2);
  const auto small = MutablePicture::contiguous(PixelFormat::Nv12, 64, 46, memory.data(), 64);
  const auto done = decoder.decode_nv12(planar_jpeg(TJSAMP_420), small);
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("72x46 instead of 64x46"), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::hal
