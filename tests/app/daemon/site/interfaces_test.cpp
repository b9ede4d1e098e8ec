// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/interfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <type_traits>

#include "app/model/status/status.h"

namespace orbwatch::app::daemon {
namespace {

std::string lower(std::string_view text) {
  std::string letters(text);
  std::ranges::transform(letters, letters.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return letters;
}

TEST(InterfaceFaults, TheFiguresTextSaysWhichBitIsWhich) {
  std::string description;
  for_each_field(std::type_identity<SystemStatus>{}, [&](const auto& field) {
    if (field.name == "interface_faults") description = lower(field.description);
  });
  std::string bits;
  for (std::size_t i = 0; i < kInterfaceNames.size(); ++i) {
    bits += (i == 0 ? "" : ", ") + std::to_string(i) + " " + lower(kInterfaceNames[i]);
  }
  EXPECT_TRUE(description.ends_with(": " + bits)) << description << "\n" << bits;
}

}  // namespace
}  // namespace orbwatch::app::daemon
