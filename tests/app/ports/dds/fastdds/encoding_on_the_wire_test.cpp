// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "app/ports/dds/dds_sink.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/fastdds/paced_views.h"
#include "tests/app/ports/dds/fastdds/reader_program.h"
#include "tests/app/ports/dds/fastdds/shipped_network.h"
#include "tests/app/ports/dds/offering_sink.h"

/// Pictures in the other encodings, compared pixel by pixel.
namespace orbwatch::app::dds {
namespace {

using orbwatch::tests::foreign_reader;
using orbwatch::tests::parsed;
using orbwatch::tests::ReaderProgram;
using tests::ShippedNetwork;

constexpr int kSmoothWidth = 320;
constexpr int kSmoothHeight = 180;

/// A smooth picture: red increases to the right, green downwards, blue is constant.
std::shared_ptr<View> smooth_view() {
  auto view = tests::make_view(0, "front", 1, kSmoothWidth, kSmoothHeight);
  for (int y = 0; y < kSmoothHeight; ++y) {
    for (int x = 0; x < kSmoothWidth; ++x) {
      std::uint8_t* pixel = view->picture.samples<std::uint8_t>().row(y) + 3 * x;
      pixel[0] = static_cast<std::uint8_t>(x * 255 / kSmoothWidth);
      pixel[1] = static_cast<std::uint8_t>(y * 255 / kSmoothHeight);
      pixel[2] = 64;
    }
  }
  return view;
}

class EncodingOnTheWire : public testing::Test {
 protected:
  void SetUp() override {
    ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
    network_.emplace(ShippedNetwork::Kind::Lan);
  }

  /// The first sample of a topic of `view`; its data is stored in data_.
  cv::FileStorage sent_and_read(PixelFormat encoding, const std::string& topic,
                                const std::string& type) {
    DdsSink sink = tests::sink_offering({.domain = tests::kDomain}, {{.encoding = encoding}});
    network_->start(sink);
    tests::PacedViews views(sink, {view_});
    const std::string file = folder_ / "data";
    ReaderProgram reader(network_->readers(),
                         foreign_reader(tests::kDomain, {"--topic", topic, "--type", type,
                                                         "--count", "1", "--receive-buffer",
                                                         tests::kReceiveBuffer, "--save", file}));
    EXPECT_TRUE(tests::eventually([&] {
      views.hand_over();
      return !reader.program().runs();
    }));
    EXPECT_EQ(reader.program().wait(), 0) << reader.printed();
    std::ifstream in(file, std::ios::binary);
    data_.assign(std::istreambuf_iterator<char>(in), {});
    const auto samples = reader.samples();
    EXPECT_EQ(samples.size(), 1U) << reader.printed();
    return samples.empty() ? cv::FileStorage() : parsed(samples.front());
  }

  const std::shared_ptr<View> view_ = smooth_view();
  orbwatch::tests::TemporaryFolder folder_;
  std::optional<ShippedNetwork> network_;
  std::vector<std::uint8_t> data_;
};

TEST_F(EncodingOnTheWire, Bgr8HasBlueFirst) {
  const auto image = sent_and_read(PixelFormat::Bgr, "rt/orbwatch/front/image_raw", "image");
  EXPECT_EQ(image["encoding"].string(), "bgr8");
  EXPECT_EQ(static_cast<int>(image["step"]), 3 * kSmoothWidth);
  ASSERT_EQ(data_.size(), view_->bytes.size());
  for (std::size_t i = 0; i < data_.size(); i += 3) {
    ASSERT_EQ(data_[i], view_->bytes[i + 2]);
    ASSERT_EQ(data_[i + 1], view_->bytes[i + 1]);
    ASSERT_EQ(data_[i + 2], view_->bytes[i]);
  }
}

TEST_F(EncodingOnTheWire, Mono8IsTheBrightness) {
  const auto image = sent_and_read(PixelFormat::Grey, "rt/orbwatch/front/image_raw", "image");
  EXPECT_EQ(image["encoding"].string(), "mono8");
  EXPECT_EQ(static_cast<int>(image["step"]), kSmoothWidth);
  ASSERT_EQ(data_.size(), view_->bytes.size() / 3);
  for (std::size_t i = 0; i < data_.size(); ++i) {
    const std::uint8_t* rgb = view_->bytes.data() + 3 * i;
    // Luma by ITU-R BT.601 from 8-bit samples.
    ASSERT_NEAR(data_[i], 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2], 1.5);
  }
}

TEST_F(EncodingOnTheWire, JpegShowsThePicture) {
  const auto image =
      sent_and_read(PixelFormat::Rgb, "rt/orbwatch/front/image_raw/compressed", "compressed_image");
  EXPECT_NE(image["format"].string().find("jpeg"), std::string::npos) << image["format"].string();
  EXPECT_EQ(image["frame_id"].string(), "front");
  const cv::Mat bgr = cv::imdecode(data_, cv::IMREAD_COLOR);
  ASSERT_EQ(bgr.size(), cv::Size(kSmoothWidth, kSmoothHeight));
  double difference = 0;
  for (int y = 0; y < kSmoothHeight; ++y) {
    for (int x = 0; x < kSmoothWidth; ++x) {
      const auto pixel = bgr.at<cv::Vec3b>(y, x);
      const std::uint8_t* rgb = view_->picture.samples<std::uint8_t>().row(y) + 3 * x;
      for (int c = 0; c < 3; ++c) difference += std::abs(pixel[2 - c] - rgb[c]);
    }
  }
  EXPECT_LT(difference / (3.0 * kSmoothWidth * kSmoothHeight), 3) << "mean, of 255";
}

}  // namespace
}  // namespace orbwatch::app::dds
