// SPDX-License-Identifier: Apache-2.0
#include "hal/libraries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

TEST(Libraries, AreNamedWithTheirVersions) {
  std::vector<std::string> names;
  for (const auto& [name, version] : library_versions()) {
    names.push_back(name);
    EXPECT_THAT(version, testing::ContainsRegex("[0-9]+\\.[0-9]+")) << name;
  }
  EXPECT_THAT(names, testing::ElementsAre("libgpiod", "libjpeg-turbo"));
}

}  // namespace
}  // namespace orbwatch::hal
