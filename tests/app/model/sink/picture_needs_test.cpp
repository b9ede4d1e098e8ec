// SPDX-License-Identifier: Apache-2.0
#include "app/model/sink/picture_needs.h"

#include <gtest/gtest.h>

namespace orbwatch::app {
namespace {

constexpr PictureNeeds kRgb{true, false, false, false}, kBgr{false, true, false, false},
    kGrey{false, false, true, false}, kJpeg{false, false, false, true};

std::optional<PixelFormat> format(std::initializer_list<PictureNeeds> readers, int width = 64) {
  PictureNeeds all;
  for (const PictureNeeds& needs : readers) all |= needs;
  return format_for(all, width, 48);
}

TEST(PictureNeeds, OneFormatServesAllReaders) {
  EXPECT_EQ(format({}), std::nullopt);
  EXPECT_EQ(format({kGrey}), PixelFormat::Grey);
  EXPECT_EQ(format({kBgr}), PixelFormat::Bgr);
  EXPECT_EQ(format({kJpeg}), PixelFormat::I420);
  EXPECT_EQ(format({kGrey, kJpeg}), PixelFormat::I420) << "its first plane is grey";
  EXPECT_EQ(format({kBgr, kJpeg, kGrey}), PixelFormat::Bgr);
  EXPECT_EQ(format({kGrey, kBgr, kRgb, kJpeg}), PixelFormat::Rgb);
  EXPECT_EQ(format({kJpeg}, 63), PixelFormat::Rgb) << "two by two pixels share chroma";
}

TEST(PictureNeeds, AReaderOfAnEncodingNeedsIt) {
  for (const PixelFormat encoding : {PixelFormat::Rgb, PixelFormat::Bgr, PixelFormat::Grey}) {
    EXPECT_EQ(format({need_of(encoding)}), encoding);
  }
}

}  // namespace
}  // namespace orbwatch::app
