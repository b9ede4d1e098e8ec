// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/received_image.h"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace orbwatch::app::cli {
namespace {

/// Message that owns its data.
struct OwnedImage {
  std::string encoding = "rgb8";
  std::vector<std::uint8_t> bytes;
  dds::ImageMessage message{};

  OwnedImage(std::string name, std::uint32_t width, std::uint32_t height, std::uint32_t step)
      : encoding(std::move(name)), bytes(std::size_t{step} * height) {
    message.encoding = encoding.data();
    message.width = width;
    message.height = height;
    message.step = step;
    const auto size = static_cast<std::uint32_t>(bytes.size());
    message.data = {size, size, bytes.data(), false};
  }
};

TEST(CheckImageTest, SoundImagesPass) {
  for (const auto& encoding : dds::kImageEncodings) {
    const OwnedImage tight(std::string(encoding.name), 5, 4, 5 * encoding.bytes_per_pixel());
    const auto image = check_image(tight.message);
    ASSERT_TRUE(image) << encoding.name << ": " << image.error().message;
    EXPECT_EQ(image->encoding.name, encoding.name);
    EXPECT_EQ(image->width, 5u);
    EXPECT_EQ(image->height, 4u);
    EXPECT_EQ(image->data, tight.bytes.data());
    const OwnedImage padded(std::string(encoding.name), 5, 4, 5 * encoding.bytes_per_pixel() + 6);
    EXPECT_TRUE(check_image(padded.message)) << encoding.name;
  }
}

TEST(CheckImageTest, ByteOrderCountsForWideSamplesOnly) {
  OwnedImage wide("mono16", 2, 2, 4);
  wide.message.is_bigendian = dds::kBigEndianHost ? 0 : 1;
  EXPECT_TRUE(check_image(wide.message)->swapped);
  wide.message.is_bigendian = dds::kBigEndianHost ? 1 : 0;
  EXPECT_FALSE(check_image(wide.message)->swapped);
  OwnedImage narrow("mono8", 2, 2, 2);
  narrow.message.is_bigendian = dds::kBigEndianHost ? 0 : 1;
  EXPECT_FALSE(check_image(narrow.message)->swapped);
}

struct Damage {
  const char* name;
  std::function<void(OwnedImage&)> apply;
  const char* message;
};

void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }

class CheckImageDamageTest : public testing::TestWithParam<Damage> {};

TEST_P(CheckImageDamageTest, IsRefused) {
  OwnedImage image("rgb8", 8, 6, 24);
  GetParam().apply(image);
  const auto checked = check_image(image.message);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().message, GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, CheckImageDamageTest,
    testing::Values(Damage{"MissingByte",
                           [](OwnedImage& image) { image.message.data._length -= 1; },
                           "image: 143 bytes of data, step and height say 144"},
                    Damage{"NoData", [](OwnedImage& image) { image.message.data = {}; },
                           "image: 0 bytes of data, step and height say 144"},
                    Damage{"RowsLongerThanStep", [](OwnedImage& image) { image.message.width = 9; },
                           "image: step of 24 bytes, a row needs 27"},
                    Damage{"HalfASampleMore",
                           [](OwnedImage& image) {
                             image.encoding = "mono16";
                             image.message.encoding = image.encoding.data();
                             image.message.step = 23;
                           },
                           "image: step of 23 bytes, samples have 2"},
                    // 2^31 rows of 2 bytes: in 32 bits the product would be 0.
                    Damage{"ProductOverflows",
                           [](OwnedImage& image) {
                             image.message.height = 0x80000000u;
                             image.message.step = 24;
                           },
                           "image: 8 x 2147483648 pixels, each side must be 1 to 16384"},
                    Damage{"StepOverflows",
                           [](OwnedImage& image) {
                             image.message.height = 16;
                             image.message.step = 0x10000000u;
                             image.message.data._length = 0;
                           },
                           "image: 0 bytes of data, step and height say 4294967296"},
                    Damage{"RowOverflows",
                           [](OwnedImage& image) { image.message.width = 0x55555556u; },
                           "image: 1431655766 x 6 pixels, each side must be 1 to 16384"},
                    Damage{"NoWidth", [](OwnedImage& image) { image.message.width = 0; },
                           "image: 0 x 6 pixels, each side must be 1 to 16384"},
                    Damage{"UnknownEncoding",
                           [](OwnedImage& image) {
                             image.encoding = "nv12";
                             image.message.encoding = image.encoding.data();
                           },
                           "image: encoding is none of rgb8, bgr8, mono8, mono16"}),
    [](const auto& damage) { return std::string(damage.param.name); });

}  // namespace
}  // namespace orbwatch::app::cli
