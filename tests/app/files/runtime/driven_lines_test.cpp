// SPDX-License-Identifier: Apache-2.0
#include "app/files/runtime/driven_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/temporary_folder.h"

namespace orbwatch::app::files {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DrivenLines : public testing::Test {
 protected:
  std::string text() const {
    std::ifstream in(file_);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const tests::TemporaryFolder folder_;
  const fs::path file_ = folder_ / "driven-lines.toml";
};

LineSettings line(const std::string& name, LineUse use) {
  LineSettings settings;
  settings.name = name;
  settings.use = use;
  settings.wire.address.name = "GPIO_" + name;
  return settings;
}

TEST_F(DrivenLines, AreTheOutputsWithAllThatOpensThem) {
  EXPECT_EQ(driven_lines(folder_.path()).value().has_value(), false);
  LineSettings strobe = line("strobe \"1\"", LineUse::Strobe);
  strobe.wire.address = {.name = {}, .chip = "pinctrl-bcm2711", .offset = 17};
  strobe.wire.active_low = true;
  strobe.wire.bias = hal::LineBias::PullUp;
  LineSettings simulated = line("simulated", LineUse::Alarm);
  simulated.back_end = LineKind::Simulated;
  ASSERT_TRUE(record_driven_lines(folder_.path(), {line("door", LineUse::ProcessInput), strobe,
                                                   simulated, line("ok", LineUse::ProcessOk)}));
  const auto driven = driven_lines(folder_.path());
  ASSERT_TRUE(driven && *driven) << text();
  ASSERT_EQ((*driven)->size(), 2U);
  const LineSettings& first = (**driven)[0];
  EXPECT_EQ(first.name, strobe.name);
  EXPECT_FALSE(is_input(first.use));
  EXPECT_EQ(first.back_end, LineKind::Gpio);
  EXPECT_EQ(first.wire.address.text(), "pinctrl-bcm2711 line 17");
  EXPECT_TRUE(first.wire.active_low);
  EXPECT_EQ(first.wire.bias, hal::LineBias::PullUp);
  EXPECT_EQ((**driven)[1].wire.address.name, "GPIO_ok");
  EXPECT_FALSE((**driven)[1].wire.active_low);
}

TEST_F(DrivenLines, NoneIsNotTheSameAsNotRecorded) {
  ASSERT_TRUE(record_driven_lines(folder_.path(), {}));
  const auto driven = driven_lines(folder_.path());
  ASSERT_TRUE(driven && *driven);
  EXPECT_TRUE((*driven)->empty());
  forget_driven_lines(folder_.path());
  EXPECT_EQ(driven_lines(folder_.path()).value().has_value(), false);
}

/// After the board's start the kernel's driver determines the level of the wire.
TEST_F(DrivenLines, EndWithTheBoardsRun) {
  ASSERT_TRUE(record_driven_lines(folder_.path(), {line("ok", LineUse::ProcessOk)}));
  std::string other = text();
  const std::size_t boot = other.find("boot = \"");
  ASSERT_NE(boot, std::string::npos) << other;
  other.replace(boot, 8, "boot = \"other");
  std::ofstream(file_) << other;
  EXPECT_EQ(driven_lines(folder_.path()).value().has_value(), false);
}

TEST_F(DrivenLines, ThatCannotBeRecordedAreNotThoseBefore) {
  fs::create_directory(file_);
  EXPECT_FALSE(record_driven_lines(folder_.path(), {}));
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(DrivenLines, ThatAreDamagedAreRefused) {
  std::ofstream(file_) << "nonsense = ";
  EXPECT_THAT(driven_lines(folder_.path()).error().message, HasSubstr("driven-lines.toml:1"));
}

}  // namespace
}  // namespace orbwatch::app::files
