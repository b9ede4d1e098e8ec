// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/format/driver_format.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

namespace orbwatch::hal {
namespace {

ColourSpace colours(std::uint32_t colorspace, std::uint32_t encoding, std::uint32_t quantization) {
  DriverFormat format;
  format.colorspace = colorspace;
  format.ycbcr_enc = encoding;
  format.quantization = quantization;
  return colour_space_of(format);
}

TEST(V4l2ColourSpace, IsWhatTheDriverSays) {
  const auto full = colours(V4L2_COLORSPACE_SRGB, V4L2_YCBCR_ENC_709, V4L2_QUANTIZATION_FULL_RANGE);
  EXPECT_EQ(full.matrix, ColourMatrix::Bt709);
  EXPECT_EQ(full.range, ColourRange::Full);
  const auto limited =
      colours(V4L2_COLORSPACE_JPEG, V4L2_YCBCR_ENC_601, V4L2_QUANTIZATION_LIM_RANGE);
  EXPECT_EQ(limited.matrix, ColourMatrix::Bt601);
  EXPECT_EQ(limited.range, ColourRange::Limited);
}

/// Defaults from the V4L2 specification, "Colorspaces in detail".
TEST(V4l2ColourSpace, FollowsTheSpecificationWhereTheDriverIsSilent) {
  const struct {
    std::uint32_t colorspace;
    ColourMatrix matrix;
    ColourRange range;
  } cases[] = {
      {V4L2_COLORSPACE_SMPTE170M, ColourMatrix::Bt601, ColourRange::Limited},
      {V4L2_COLORSPACE_SRGB, ColourMatrix::Bt601, ColourRange::Limited},
      {V4L2_COLORSPACE_JPEG, ColourMatrix::Bt601, ColourRange::Full},
      {V4L2_COLORSPACE_REC709, ColourMatrix::Bt709, ColourRange::Limited},
  };
  for (const auto& [colorspace, matrix, range] : cases) {
    const auto space = colours(colorspace, V4L2_YCBCR_ENC_DEFAULT, V4L2_QUANTIZATION_DEFAULT);
    EXPECT_EQ(space.matrix, matrix) << colorspace;
    EXPECT_EQ(space.range, range) << colorspace;
  }
}

DriverFormat format(std::uint32_t fourcc, std::initializer_list<std::uint32_t> strides) {
  DriverFormat format;
  format.width = 640;
  format.height = 480;
  format.fourcc = fourcc;
  format.memory_count = strides.size();
  std::size_t n = 0;
  for (const std::uint32_t stride : strides) format.memory[n++].stride = stride;
  return format;
}

DriverLayout layout(std::uint32_t fourcc, std::initializer_list<std::uint32_t> strides) {
  return driver_layout(*find_coding(fourcc), format(fourcc, strides));
}

void expect_plane(const DriverLayout& layout, std::size_t n, DriverLayout::Plane plane) {
  EXPECT_EQ(layout.planes[n].memory, plane.memory) << "plane " << n;
  EXPECT_EQ(layout.planes[n].offset, plane.offset) << "plane " << n;
  EXPECT_EQ(layout.planes[n].stride, plane.stride) << "plane " << n;
}

/// Layouts of NV12 and YUV420 in the V4L2 documentation: chroma follows luma with its stride in
/// proportion.
TEST(DriverLayout, FollowsThePlanesOfOneStretch) {
  const auto nv12 = layout(V4L2_PIX_FMT_NV12, {704});
  ASSERT_EQ(nv12.plane_count, 2U);
  ASSERT_EQ(nv12.memory_count, 1U);
  expect_plane(nv12, 0, {0, 0, 704});
  expect_plane(nv12, 1, {0, 704 * 480, 704});
  EXPECT_EQ(nv12.needed[0], 704U * 720);
  const auto yuv420 = layout(V4L2_PIX_FMT_YUV420, {704});
  ASSERT_EQ(yuv420.plane_count, 3U);
  expect_plane(yuv420, 1, {0, 704 * 480, 352});
  expect_plane(yuv420, 2, {0, 704 * 600, 352});
  EXPECT_EQ(yuv420.needed[0], 704U * 720);
}

TEST(DriverLayout, GivesEachPlaneItsStretch) {
  const auto nv12m = layout(V4L2_PIX_FMT_NV12M, {704, 768});
  ASSERT_EQ(nv12m.memory_count, 2U);
  expect_plane(nv12m, 0, {0, 0, 704});
  expect_plane(nv12m, 1, {1, 0, 768});
  EXPECT_EQ(nv12m.needed[0], 704U * 480);
  EXPECT_EQ(nv12m.needed[1], 768U * 240);
  const auto yuv420m = layout(V4L2_PIX_FMT_YUV420M, {640, 320, 320});
  ASSERT_EQ(yuv420m.memory_count, 3U);
  expect_plane(yuv420m, 2, {2, 0, 320});
  EXPECT_EQ(yuv420m.needed[2], 320U * 240);
}

TEST(DriverLayout, TakesNoStrideForPaddingThatIsTooSmall) {
  expect_plane(layout(V4L2_PIX_FMT_GREY, {0}), 0, {0, 0, 640});
  expect_plane(layout(V4L2_PIX_FMT_YUYV, {100}), 0, {0, 0, 1280});
  expect_plane(layout(V4L2_PIX_FMT_NV12M, {0, 0}), 1, {1, 0, 640});
  expect_plane(layout(V4L2_PIX_FMT_YUV420M, {0, 0, 0}), 2, {2, 0, 320});
}

TEST(DriverLayout, CountsPackedBytes) {
  const auto packed = layout(V4L2_PIX_FMT_Y10P, {0});
  expect_plane(packed, 0, {0, 0, 800});
  EXPECT_EQ(packed.needed[0], 800U * 480);
  EXPECT_EQ(layout(V4L2_PIX_FMT_SRGGB12P, {1024}).needed[0], 1024U * 480);
  EXPECT_EQ(layout(V4L2_PIX_FMT_MJPEG, {1280}).needed[0], 1U) << "any JPEG picture";
}

}  // namespace
}  // namespace orbwatch::hal
