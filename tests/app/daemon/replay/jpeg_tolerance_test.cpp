// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/replay/jpeg_tolerance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>

#include "app/pictures/jpeg_encoder.h"
#include "hal/jpeg/jpeg_decoder.h"
#include "tests/app/daemon/measured_sequence.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/reference_data.h"
#include "tests/support/rendered_scene.h"

/// Measurements of pictures that were coded as JPEG.
namespace orbwatch::app::daemon {
namespace {

using optics::Vec3;
using tests::MeasuredSequence, tests::RenderedSequence, tests::rendered_pictures;

/// The picture after JPEG of this quality.
cv::Mat coded(const cv::Mat& grey, int quality) {
  JpegEncoder encoder;
  const auto jpeg = encoder.encode(tests::picture_of_mat(grey), quality);
  cv::Mat decoded(grey.size(), CV_8U);
  const ImageView<std::uint8_t> target{decoded.data, grey.cols, grey.rows, 1, grey.cols};
  EXPECT_TRUE(hal::JpegDecoder().decode_packed(std::as_bytes(jpeg.value()), target));
  return decoded;
}

signals::RegionSettings region_of(const RenderedSequence& sequence) {
  signals::RegionSettings region;
  region.full_scale = 255;
  region.hot_spot_threshold = 235;
  region.plume_threshold = 180;
  region.spatter_threshold = 200;
  region.width_set_point = 10;
  for (const Vec3& corner :
       {Vec3{-190, -130, 178}, {-30, -130, 178}, {-30, 30, 178}, {-190, 30, 178}}) {
    region.outline.push_back(corner - sequence.scene().ball.centre);
  }
  return region;
}

TEST(JpegTolerance, HoldsForARenderedProcessAtItsQuality) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures() / "scene.json");
  const RenderedSequence sequence("seq_spark");
  MeasuredSequence lossless(sequence, PixelFormat::Grey, region_of(sequence));
  MeasuredSequence lossy(sequence, PixelFormat::Grey, region_of(sequence));
  std::map<std::string_view, double> largest;
  for (std::size_t n = 0; n < sequence.frames().size(); ++n) {
    const auto before = lossless.measure(n);
    const auto after = lossy.measure(n, coded(lossless.read(n), kLeastJpegQuality));
    for (const JpegTolerance& tolerance : kJpegTolerances) {
      const auto signal =
          std::ranges::find(signals::kSignals, tolerance.signal, &signals::SignalInfo::name);
      ASSERT_NE(signal, signals::kSignals.end()) << tolerance.signal;
      const double a = before.*signal->member, b = after.*signal->member;
      EXPECT_EQ(std::isnan(a), std::isnan(b)) << tolerance.signal << " in frame " << n;
      if (std::isnan(a)) continue;
      EXPECT_TRUE(is_explained_by_jpeg(tolerance.signal, kLeastJpegQuality, a, b))
          << tolerance.signal << " in frame " << n << ": " << a << ", " << b;
      largest[tolerance.signal] = std::max(largest[tolerance.signal], std::abs(a - b));
    }
  }
  for (const auto& [signal, difference] : largest) {
    std::printf("%-34s %9.4f\n", std::string(signal).c_str(), difference);
  }
}

TEST(JpegTolerance, IsNoneForALowerQualityAnotherSignalAndValuesThatAreNotValid) {
  EXPECT_TRUE(is_explained_by_jpeg("hot_spot_width", 90, 10, 10.2));
  EXPECT_TRUE(is_explained_by_jpeg("hot_spot_width", 95, 100, 101.9));
  EXPECT_FALSE(is_explained_by_jpeg("hot_spot_width", 90, 10, 10.3));
  EXPECT_FALSE(is_explained_by_jpeg("hot_spot_width", 89, 10, 10.2));
  EXPECT_FALSE(is_explained_by_jpeg("spatter_speed", 90, 10, 10.2));
  EXPECT_FALSE(is_explained_by_jpeg("hot_spot_width", 90, 10, std::nan("")));
}

}  // namespace
}  // namespace orbwatch::app::daemon
