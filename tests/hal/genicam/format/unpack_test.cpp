// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/format/unpack.h"

#include <gmock/gmock.h>

#include <array>
#include <cstring>
#include <random>
#include <vector>

namespace orbwatch::hal {
namespace {

using testing::ElementsAre;

std::vector<std::byte> bytes(std::initializer_list<int> values) {
  std::vector<std::byte> row;
  for (const int value : values) row.push_back(static_cast<std::byte>(value));
  return row;
}

std::vector<std::uint16_t> unpacked(SamplePacking packing, const std::vector<std::byte>& row,
                                    int width) {
  std::vector<std::uint16_t> samples(static_cast<std::size_t>(width));
  unpack_samples(packing, row.data(), width, samples.data());
  return samples;
}

// Rows computed by hand from the figures of PFNC 2.4 (Mono10p, Mono12p, Mono14p, Mono10Packed,
// Mono12Packed). Samples: their bits are all different, so that none can be in another's place.

TEST(Unpack, TenBitsLowestFirst) {
  // Samples in binary: 0x155 = 01'0101'0101, 0x2aa = 10'1010'1010, 0x0f3 = 00'1111'0011, 0x30c =
  // 11'0000'1100
  EXPECT_THAT(unpacked(SamplePacking::Lsb10, bytes({0x55, 0xa9, 0x3a, 0x0f, 0xc3}), 4),
              ElementsAre(0x155, 0x2aa, 0x0f3, 0x30c));
}

TEST(Unpack, TwelveBitsLowestFirst) {
  EXPECT_THAT(unpacked(SamplePacking::Lsb12, bytes({0x23, 0x61, 0x45}), 2),
              ElementsAre(0x123, 0x456));
}

TEST(Unpack, FourteenBitsLowestFirst) {
  // Samples: 0x1234, 0x2bcd, 0x3fff, 0x0001
  EXPECT_THAT(unpacked(SamplePacking::Lsb14, bytes({0x34, 0x52, 0xf3, 0xfa, 0xff, 0x07, 0x00}), 4),
              ElementsAre(0x1234, 0x2bcd, 0x3fff, 0x0001));
}

TEST(Unpack, TenBitsOfGigeVision) {
  // Upper 8 bits of the first sample; its lower 2 in bits 0 and 1, those of the second in 4 and 5;
  // upper 8 bits of the second.
  EXPECT_THAT(unpacked(SamplePacking::Gev10, bytes({0x55, 0x21, 0xaa}), 2),
              ElementsAre(0x155, 0x2aa));
}

TEST(Unpack, TwelveBitsOfGigeVision) {
  EXPECT_THAT(unpacked(SamplePacking::Gev12, bytes({0x12, 0x63, 0x45}), 2),
              ElementsAre(0x123, 0x456));
}

/// Packs samples bit by bit, by the definition of "lsb packed".
std::vector<std::byte> pack_bits(const std::vector<std::uint16_t>& samples, int bits) {
  std::vector<std::byte> row(samples.size() * static_cast<std::size_t>(bits) / 8);
  std::size_t at = 0;
  for (const unsigned sample : samples) {
    for (int bit = 0; bit < bits; ++bit, ++at) {
      row[at / 8] |= static_cast<std::byte>((sample >> bit & 1U) << at % 8);
    }
  }
  return row;
}

TEST(Unpack, EverySampleOfLongRowsComesBack) {
  constexpr std::array<std::pair<SamplePacking, int>, 3> kPackings{
      {{SamplePacking::Lsb10, 10}, {SamplePacking::Lsb12, 12}, {SamplePacking::Lsb14, 14}}};
  std::mt19937 random(1);
  for (const auto& [packing, bits] : kPackings) {
    std::vector<std::uint16_t> samples(644);
    for (auto& sample : samples) {
      sample = static_cast<std::uint16_t>(random() & ((1U << bits) - 1));
    }
    EXPECT_EQ(unpacked(packing, pack_bits(samples, bits), 644), samples) << bits;
  }
}

std::vector<std::uint8_t> upper_bits(std::string_view name, const std::vector<std::byte>& row,
                                     int width) {
  std::vector<std::uint8_t> samples(static_cast<std::size_t>(width));
  unpack_upper_bits(*find_genicam_format(name), row.data(), width, samples.data());
  return samples;
}

TEST(Unpack, TheUpperBitsOfAMosaicInAnyPacking) {
  EXPECT_THAT(upper_bits("BayerRG8", bytes({1, 255}), 2), ElementsAre(1, 255));
  EXPECT_THAT(upper_bits("BayerRG10", bytes({0x55, 0x01, 0xaa, 0x02}), 2), ElementsAre(0x55, 0xaa));
  EXPECT_THAT(upper_bits("BayerRG12", bytes({0x23, 0x01, 0x56, 0x04}), 2), ElementsAre(0x12, 0x45));
  EXPECT_THAT(upper_bits("BayerRG10p", bytes({0x55, 0xa9, 0x3a, 0x0f, 0xc3}), 4),
              ElementsAre(0x55, 0xaa, 0x3c, 0xc3));
  EXPECT_THAT(upper_bits("BayerRG12p", bytes({0x23, 0x61, 0x45}), 2), ElementsAre(0x12, 0x45));
  EXPECT_THAT(upper_bits("BayerRG10Packed", bytes({0x55, 0x21, 0xaa}), 2), ElementsAre(0x55, 0xaa));
  EXPECT_THAT(upper_bits("BayerRG12Packed", bytes({0x12, 0x63, 0x45}), 2), ElementsAre(0x12, 0x45));
}

}  // namespace
}  // namespace orbwatch::hal
