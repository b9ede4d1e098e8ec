// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/format/genicam_format.h"

#include <gtest/gtest.h>

#include <set>

namespace orbwatch::hal {
namespace {

TEST(GenicamFormat, NamesAndCodesAreDistinctAndTheCodeSaysHowLargeAPixelIs) {
  std::set<std::string_view> names;
  std::set<std::uint32_t> codes;
  for (const GenicamFormat& format : kGenicamFormats) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_TRUE(codes.insert(format.code).second) << format.name;
    // Bits 16 to 23 of a PFNC code are the bits per pixel on the wire. GigE Vision's "Packed"
    // states 12 for 10, too.
    const std::size_t bits = format.code >> 16 & 0xff;
    EXPECT_EQ(sent_row_bytes(format, 16), 16 * bits / 8) << format.name;
    EXPECT_EQ(find_genicam_format(format.code), &format);
    EXPECT_EQ(find_genicam_format(format.name), &format);
  }
  EXPECT_EQ(find_genicam_format(0U), nullptr);
  EXPECT_EQ(find_genicam_format("Mono11"), nullptr);
}

TEST(GenicamFormat, WhatIsSentAsItIsUsedIsNotCopied) {
  EXPECT_TRUE(is_zero_copy(*find_genicam_format("Mono16"), true));
  EXPECT_TRUE(is_zero_copy(*find_genicam_format("Mono14"), true));
  EXPECT_TRUE(is_zero_copy(*find_genicam_format("YUV422_8"), true));
  EXPECT_FALSE(is_zero_copy(*find_genicam_format("Mono12p"), true));
  EXPECT_FALSE(is_zero_copy(*find_genicam_format("BayerRG8"), true));
  EXPECT_TRUE(is_zero_copy(*find_genicam_format("BayerRG8"), false));
  EXPECT_EQ(frame_format(*find_genicam_format("BayerGB12p"), true), PixelFormat::Bgr);
  EXPECT_EQ(frame_format(*find_genicam_format("BayerGB12p"), false), PixelFormat::Y12);
}

TEST(GenicamFormat, RowsHaveWholeGroups) {
  EXPECT_TRUE(is_whole(*find_genicam_format("Mono8"), 7, 5));
  EXPECT_FALSE(is_whole(*find_genicam_format("Mono10p"), 6, 5));
  EXPECT_TRUE(is_whole(*find_genicam_format("Mono10p"), 8, 5));
  EXPECT_FALSE(is_whole(*find_genicam_format("Mono12Packed"), 7, 5));
  EXPECT_FALSE(is_whole(*find_genicam_format("BayerRG8"), 8, 5));
  EXPECT_FALSE(is_whole(*find_genicam_format("YUV422_8"), 7, 4));
  EXPECT_FALSE(is_whole(*find_genicam_format("Mono8"), 0, 4));
}

}  // namespace
}  // namespace orbwatch::hal
