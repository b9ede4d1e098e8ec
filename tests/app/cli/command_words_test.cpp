// SPDX-License-Identifier: Apache-2.0
#include "app/cli/command_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbwatch::app::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Words = std::vector<std::string>;

TEST(ParseCommand, TakesNameAndArgumentsInTheirUnits) {
  const auto point = parse_command({"point_view", "2", "-115.5", "-40", "60"});
  ASSERT_TRUE(point) << point.error().message;
  EXPECT_EQ(point->code, CommandCode::PointView);
  EXPECT_THAT(point->arguments, ElementsAre(2, -115.5, -40, 60));
  const auto trigger = parse_command({"trigger"});
  ASSERT_TRUE(trigger) << trigger.error().message;
  EXPECT_EQ(trigger->code, CommandCode::Trigger);
}

TEST(ParseCommand, SaysWhatWouldBeRight) {
  const auto refusal = [](const Words& words) {
    const auto command = parse_command(words);
    return command ? std::string() : command.error().message;
  };
  EXPECT_THAT(refusal({}), HasSubstr("say which command"));
  EXPECT_THAT(refusal({"explode"}), HasSubstr("no command explode"));
  EXPECT_THAT(refusal({"point_view", "2"}), HasSubstr("point_view VIEW YAW PITCH H_FOV"));
  EXPECT_THAT(refusal({"trigger", "--domain", "3"}), HasSubstr("its form is: trigger"));
  for (const char* word : {"two", "2x", "", " 2", "+2", "0x2", "1e400"}) {
    EXPECT_THAT(refusal({"select_recipe", word}),
                HasSubstr("recipe is \"" + std::string(word) +
                          "\"; it must be a whole number, 1 to 65535"));
  }
  EXPECT_THAT(refusal({"select_recipe", "nan"}), HasSubstr("recipe is nan; it must be"));
  EXPECT_THAT(refusal({"select_recipe", "0"}), HasSubstr("recipe is 0; it must be"));
  EXPECT_THAT(refusal({"select_recipe", "2.5"}), HasSubstr("recipe is 2.5; it must be a whole"));
  EXPECT_THAT(refusal({"point_view", "0", "0", "-90.5", "0"}),
              HasSubstr("pitch is -90.5; it must be -90 to 90 deg"));
}

TEST(CommandsHelp, NamesEveryCommandAndArgument) {
  const std::string help = commands_help();
  for (const CommandInfo& info : kCommands) {
    EXPECT_THAT(help, HasSubstr("  " + std::string(info.name)));
    EXPECT_THAT(help, HasSubstr(info.description));
    for (std::size_t i = 0; i < info.argument_count(); ++i) {
      EXPECT_THAT(help, HasSubstr(info.arguments[i].description));
    }
  }
}

}  // namespace
}  // namespace orbwatch::app::cli
