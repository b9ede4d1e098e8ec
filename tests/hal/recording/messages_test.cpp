// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/messages.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hal/mcap/cdr.h"
#include "hal/recording/topics.h"

namespace orbwatch::hal::recording {
namespace {

using mcap::Bytes;

TEST(PictureMessages, ReturnFromCdr) {
  CameraInfo info{header_at(42'000'000'001, "south"),
                  480,
                  640,
                  "plumb_bob",
                  {1, 2, 3, 4, 5},
                  {9},
                  {8},
                  {7},
                  1,
                  1,
                  {4, 6, 8, 10, true}};
  info.k.back() = 1;
  Bytes bytes;
  mcap::encode_cdr(info, bytes);
  CameraInfo read;
  ASSERT_TRUE(mcap::decode_cdr(bytes, read));
  EXPECT_EQ(read.header, info.header);
  EXPECT_EQ(read.height, 480U);
  EXPECT_EQ(read.width, 640U);
  EXPECT_EQ(read.distortion_model, "plumb_bob");
  EXPECT_EQ(read.d, info.d);
  EXPECT_EQ(read.k, info.k);
  EXPECT_EQ(read.r, info.r);
  EXPECT_EQ(read.p, info.p);
  EXPECT_EQ(read.binning_x, 1U);
  EXPECT_EQ(read.roi, info.roi);

  const Bytes jpeg(7, std::byte{0xd8});
  mcap::encode_cdr(CompressedImage{header_at(5, "south"), std::string(kGreyJpeg), jpeg}, bytes);
  CompressedImage compressed;
  ASSERT_TRUE(mcap::decode_cdr(bytes, compressed));
  EXPECT_EQ(compressed.format, kGreyJpeg);
  EXPECT_TRUE(std::ranges::equal(compressed.data, jpeg));
}

TEST(PictureMessages, StampsReturnFromTheHeader) {
  for (const std::uint64_t stamp :
       {std::uint64_t{0}, std::uint64_t{999'999'999}, std::uint64_t{1'700'000'000'000'000'001}}) {
    EXPECT_EQ(stamp_of(header_at(stamp, "")), stamp);
  }
  EXPECT_EQ(stamp_of({-1, 0, ""}), std::nullopt);
  EXPECT_EQ(stamp_of({0, 1'000'000'000, ""}), std::nullopt);
}

TEST(PictureTopics, NameTheirCamera) {
  EXPECT_EQ(image_topic("orbwatch", "north"), "/orbwatch/north/image_raw");
  EXPECT_EQ(compressed_topic("orbwatch", "north"), "/orbwatch/north/image_raw/compressed");
  EXPECT_EQ(camera_info_topic("orbwatch", "north"), "/orbwatch/north/camera_info");
  for (const auto& topic : {image_topic("cell/7", "north"), compressed_topic("a", "north"),
                            camera_info_topic("a", "north")}) {
    EXPECT_EQ(camera_of(topic), "north") << topic;
  }
  for (const char* topic : {"", "/image_raw", "//image_raw", "north/image_raw",
                            "/orbwatch/process_state", "/orbwatch/north/image_raw/theora"}) {
    EXPECT_EQ(camera_of(topic), std::nullopt) << topic;
  }
}

}  // namespace
}  // namespace orbwatch::hal::recording
