// SPDX-License-Identifier: Apache-2.0
#include "app/watch/kept_file.h"

#include <gtest/gtest.h>

namespace orbwatch::app {
namespace {

/// Numbers in the names of files that earlier versions kept: an update must find them.
TEST(KeptFile, IsNamedAfterTheOutline) {
  const optics::Outline outline{{400.25, 300.5}, 123.456789012, 123.4, -0.0};
  EXPECT_EQ(kept_file("state", "aligned", "left", outline), "state/aligned-left-df3d8c0e.png");
  EXPECT_NE(kept_file("state", "aligned", "left", {{400.25, 300.5}, 123.5, 123.4, 0}),
            kept_file("state", "aligned", "left", outline));
}

}  // namespace
}  // namespace orbwatch::app
