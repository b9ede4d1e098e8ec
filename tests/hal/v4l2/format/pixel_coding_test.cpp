// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/format/pixel_coding.h"

#include <gtest/gtest.h>

#include <set>

namespace orbwatch::hal {
namespace {

TEST(PixelCodings, HaveOneNameAndOneCodeEach) {
  std::set<std::string_view> names{"auto"};
  std::set<std::uint32_t> codes;
  for (const PixelCoding& coding : kPixelCodings) {
    EXPECT_TRUE(names.insert(coding.name).second) << coding.name;
    EXPECT_TRUE(codes.insert(coding.fourcc).second) << coding.name;
    EXPECT_EQ(find_coding(coding.fourcc), &coding);
    EXPECT_LE(coding.memory_count, info(coding.format).plane_count()) << coding.name;
  }
  EXPECT_EQ(kPixelCodingNames.front(), "auto");
  EXPECT_EQ(find_coding(V4L2_PIX_FMT_H264), nullptr);
}

const PixelCoding& named(std::string_view name) {
  for (const PixelCoding& coding : kPixelCodings) {
    if (coding.name == name) return coding;
  }
  ADD_FAILURE() << name;
  return kPixelCodings[0];
}

TEST(PixelCoding, SaysWhatFramesBecome) {
  EXPECT_EQ(frame_format(named("rggb10p"), true), PixelFormat::Bgr);
  EXPECT_EQ(frame_format(named("rggb10p"), false), PixelFormat::Y10);
  EXPECT_EQ(frame_format(named("mjpeg"), true), PixelFormat::Nv12);
  EXPECT_EQ(frame_format(named("mjpeg"), false), PixelFormat::Grey);
  EXPECT_EQ(frame_format(named("nv21m"), false), PixelFormat::Nv21);
  EXPECT_EQ(frame_format(named("grey"), true), PixelFormat::Grey);
}

TEST(PixelCoding, KnowsWhichSizesAreWhole) {
  const struct {
    const char* name;
    int columns;
    int rows;
  } groups[] = {{"grey", 1, 1},    {"yuyv", 2, 1}, {"nv12", 2, 2}, {"yuv420m", 2, 2},
                {"mjpeg", 2, 2},   {"y10p", 4, 1}, {"y12p", 2, 1}, {"rggb16", 2, 2},
                {"bggr10p", 4, 2}, {"rgb24", 1, 1}};
  for (const auto& group : groups) {
    for (int width = 1; width <= 9; ++width) {
      for (int height = 1; height <= 5; ++height) {
        EXPECT_EQ(is_whole(named(group.name), true, width, height),
                  width % group.columns == 0 && height % group.rows == 0)
            << group.name << " " << width << "x" << height;
      }
    }
    EXPECT_FALSE(is_whole(named(group.name), true, 0, 4));
    EXPECT_FALSE(is_whole(named(group.name), true, 4, 0));
  }
  EXPECT_TRUE(is_whole(named("mjpeg"), false, 7, 5)) << "luminance has no pairs";
}

TEST(PixelCoding, KnowsItsRows) {
  EXPECT_EQ(packed_row_bytes(named("y10p"), 640), 800U);
  EXPECT_EQ(packed_row_bytes(named("y12p"), 640), 960U);
  EXPECT_EQ(packed_row_bytes(named("y16_be"), 640), 1280U);
  EXPECT_EQ(packed_row_bytes(named("yuyv"), 640), 1280U);
  EXPECT_EQ(packed_row_bytes(named("nv12m"), 640), 640U);
  EXPECT_EQ(packed_row_bytes(named("mjpeg"), 640), 0U);
}

}  // namespace
}  // namespace orbwatch::hal
