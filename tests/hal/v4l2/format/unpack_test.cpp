// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/format/frame_decoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace orbwatch::hal {
namespace {

using testing::ElementsAre;

std::vector<std::byte> bytes(std::initializer_list<unsigned> values) {
  std::vector<std::byte> row;
  for (const unsigned value : values) row.push_back(static_cast<std::byte>(value));
  return row;
}

std::vector<std::uint16_t> unpacked(Packing packing, const std::vector<std::byte>& row, int width) {
  std::vector<std::uint16_t> samples(static_cast<std::size_t>(width) + 1, 0xeeee);
  unpack_row(packing, row.data(), width, samples.data());
  EXPECT_EQ(samples.back(), 0xeeee) << "wrote behind the row";
  samples.pop_back();
  return samples;
}

/// Bits from the figures of V4L2_PIX_FMT_Y10P and V4L2_PIX_FMT_Y12P in the Linux documentation.
TEST(Unpack, FollowsTheDocumentation) {
  EXPECT_THAT(unpacked(Packing::Mipi10, bytes({0xab, 0xcd, 0xef, 0x12, 0b11'10'01'00}), 4),
              ElementsAre(0b10'1010'1100, 0b11'0011'0101, 0b11'1011'1110, 0b00'0100'1011));
  EXPECT_THAT(unpacked(Packing::Mipi12, bytes({0xab, 0xcd, 0x7e}), 2), ElementsAre(0xabe, 0xcd7));
  EXPECT_THAT(unpacked(Packing::BigEndian, bytes({0x12, 0x34, 0xff, 0x00}), 2),
              ElementsAre(0x1234, 0xff00));
}

/// Writes the bits of each group one by one: the upper 8 of every sample, then the rest, from the
/// last sample on.
std::vector<std::byte> packed(const std::vector<std::uint16_t>& samples, int bits) {
  const std::size_t group = bits == 10 ? 4 : 2;
  std::vector<std::byte> row;
  for (std::size_t first = 0; first < samples.size(); first += group) {
    unsigned rest = 0;
    for (std::size_t i = 0; i < group; ++i) {
      const unsigned sample = samples[first + i];
      row.push_back(static_cast<std::byte>(sample >> (bits - 8)));
      rest += (sample % (1U << (bits - 8))) << (static_cast<unsigned>(bits - 8) * i);
    }
    row.push_back(static_cast<std::byte>(rest));
  }
  return row;
}

class UnpackBits : public testing::TestWithParam<int> {};

TEST_P(UnpackBits, FindsWhatWasPacked) {
  const int bits = GetParam();
  const Packing packing = bits == 10 ? Packing::Mipi10 : Packing::Mipi12;
  std::mt19937 random(7);
  std::vector<std::uint16_t> samples(1000);
  for (auto& sample : samples) sample = static_cast<std::uint16_t>(random() % (1U << bits));
  const auto row = packed(samples, bits);
  EXPECT_EQ(row.size(), packed_row_bytes({"", 0, PixelFormat::Y16, packing}, 1000));
  EXPECT_EQ(unpacked(packing, row, 1000), samples);
  std::vector<std::uint8_t> upper(1000);
  unpack_row_to_8_bit(packing, bits, row.data(), 1000, upper.data());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ASSERT_EQ(upper[i], samples[i] >> (bits - 8)) << "sample " << i;
  }
}
INSTANTIATE_TEST_SUITE_P(Mipi, UnpackBits, testing::Values(10, 12));

TEST(Unpack, KeepsTheUpperBitsOfWholeSamples) {
  std::vector<std::uint8_t> upper(2);
  const auto row = bytes({0x34, 0x02, 0xff, 0x03});  // 10 bit: 0x234, 0x3ff
  unpack_row_to_8_bit(Packing::None, 10, row.data(), 2, upper.data());
  EXPECT_THAT(upper, ElementsAre(0x8d, 0xff));
  unpack_row_to_8_bit(Packing::None, 16, row.data(), 2, upper.data());
  EXPECT_THAT(upper, ElementsAre(0x02, 0x03));
  unpack_row_to_8_bit(Packing::BigEndian, 16, row.data(), 2, upper.data());
  EXPECT_THAT(upper, ElementsAre(0x34, 0xff));
  unpack_row_to_8_bit(Packing::None, 8, row.data(), 2, upper.data());
  EXPECT_THAT(upper, ElementsAre(0x34, 0x02));
}

}  // namespace
}  // namespace orbwatch::hal
