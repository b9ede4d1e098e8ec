// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/picture_sizes.h"

#include <gmock/gmock.h>

#include "proc/image/picture.h"

namespace orbwatch::app::web::tests {
namespace {

using testing::ElementsAre;

TEST(PictureSizes, AreQuartersOfTheView) {
  EXPECT_THAT(widths_of(1024), ElementsAre(1024, 768, 512, 256));
  EXPECT_THAT(widths_of(90), ElementsAre(90, 68, 46, 24)) << "even";
}

TEST(PictureSizes, TheSmallestThatIsWideEnoughIsSent) {
  EXPECT_EQ(size_for(0, 1024), kFullSize) << "not stated";
  EXPECT_EQ(size_for(kMaxSide, 1024), kFullSize);
  EXPECT_EQ(size_for(769, 1024), kFullSize);
  EXPECT_EQ(side_in(size_for(768, 1024), 1024), 768);
  EXPECT_EQ(side_in(size_for(390, 1024), 1024), 512);
  EXPECT_EQ(side_in(size_for(1, 1024), 1024), 256);
}

TEST(PictureSizes, OfEveryViewAreWithinItAndNotEmpty) {
  for (int full = 1; full <= kMaxSide; ++full) {
    int larger = full;
    for (const int width : widths_of(full)) {
      ASSERT_GE(width, 1) << full;
      ASSERT_LE(width, larger) << full;
      ASSERT_TRUE(width % 2 == 0 || width == full) << full;
      larger = width;
    }
    for (const int shown : {1, full / 4, full / 2, full - 1, full}) {
      ASSERT_GE(side_in(size_for(shown, full), full), shown) << full;
    }
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
