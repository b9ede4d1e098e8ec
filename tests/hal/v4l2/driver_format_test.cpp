#include "hal/v4l2/driver_format.h"

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

/// Defaults of the V4L2 specification, "Colorspaces in detail".
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

}  // namespace
}  // namespace orbwatch::hal
