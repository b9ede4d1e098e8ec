// SPDX-License-Identifier: Apache-2.0
#include "app/model/command/command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>

#include "app/pictures/colour_maps.h"

namespace orbwatch::app {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string trace(const CommandInfo& info, std::size_t argument) {
  return std::string(info.name) + ", argument " + std::to_string(argument);
}

Command lowest(const CommandInfo& info) {
  Command command{info.code, {}};
  for (std::size_t i = 0; i < info.argument_count(); ++i) {
    command.arguments[i] = info.arguments[i].minimum;
  }
  return command;
}

/// Calls `examine` for every argument of every command, with a valid command.
template <class Examine>
void for_each_argument(const Examine& examine) {
  for (const CommandInfo& info : kCommands) {
    for (std::size_t i = 0; i < info.argument_count(); ++i) {
      SCOPED_TRACE(trace(info, i));
      examine(lowest(info), i, info.arguments[i]);
    }
  }
}

/// Checks a command with this value of an argument; an argument that must be above it has its
/// maximum.
CommandResult check_with(Command command, std::size_t argument, double value) {
  const ArgumentInfo* const info = &find_command(command.code)->arguments[argument];
  if (info->is_below_next) command.arguments[argument + 1] = info[1].maximum;
  command.arguments[argument] = value;
  return check(command);
}

TEST(Commands, AreFoundByTheirCode) {
  for (const CommandInfo& info : kCommands) EXPECT_EQ(find_command(info.code), &info);
  for (const int code : {0, static_cast<int>(kCommands.back().code) + 1, 1000, 65535}) {
    EXPECT_EQ(find_command(static_cast<CommandCode>(code)), nullptr) << code;
    EXPECT_EQ(check({static_cast<CommandCode>(code), {}}), CommandResult::UnknownCommand) << code;
  }
}

TEST(Commands, HaveCodesNamesAndArgumentsOfTheirOwn) {
  std::set<CommandCode> codes;
  std::set<std::string_view> names;
  for (const CommandInfo& info : kCommands) {
    EXPECT_TRUE(codes.insert(info.code).second) << info.name;
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.description.empty()) << info.name;
    std::set<std::string_view> arguments;
    for (std::size_t i = 0; i < info.argument_count(); ++i) {
      EXPECT_TRUE(arguments.insert(info.arguments[i].name).second) << trace(info, i);
    }
    for (std::size_t i = info.argument_count(); i < kMaxArguments; ++i) {
      EXPECT_TRUE(info.arguments[i].name.empty()) << trace(info, i) << " comes after a gap";
    }
  }
}

TEST(Commands, TakeTheEndsOfTheirRangesAndNothingBeyond) {
  for_each_argument([](const Command& command, std::size_t i, const ArgumentInfo& argument) {
    ASSERT_LT(argument.minimum, argument.maximum);
    ASSERT_GT(argument.scale, 0);
    EXPECT_EQ(check_with(command, i, argument.minimum), CommandResult::Done);
    EXPECT_EQ(check_with(command, i, argument.maximum), CommandResult::Done);
    for (const double beyond :
         {argument.minimum - argument.scale, argument.maximum + argument.scale,
          std::nextafter(argument.minimum, -kInfinity), std::nextafter(argument.maximum, kInfinity),
          -1e300, 1e300}) {
      EXPECT_EQ(check_with(command, i, beyond), CommandResult::ArgumentOutOfRange) << beyond;
    }
  });
}

TEST(Commands, RefuseWhatIsNoNumber) {
  for_each_argument([](const Command& command, std::size_t i, const ArgumentInfo&) {
    for (const double bad : {kNan, -kNan, kInfinity, -kInfinity}) {
      EXPECT_EQ(check_with(command, i, bad), CommandResult::ArgumentOutOfRange) << bad;
    }
  });
}

TEST(Commands, TakeFractionsOnlyWhereTheyMeanSomething) {
  for_each_argument([](const Command& command, std::size_t i, const ArgumentInfo& argument) {
    const double middle = std::floor((argument.minimum + argument.maximum) / 2) + 0.5;
    const double fraction = middle < argument.maximum ? middle : argument.minimum + 0.5;
    EXPECT_EQ(check_with(command, i, fraction),
              argument.scale == 1 ? CommandResult::ArgumentOutOfRange : CommandResult::Done);
    EXPECT_EQ(check_with(command, i, -0.0), check_with(command, i, 0.0));
  });
}

TEST(Commands, EveryArgumentCountsWhateverTheOthersAre) {
  Command point{CommandCode::PointView, {3, -180, 90, 0}};
  EXPECT_EQ(check(point), CommandResult::Done);
  EXPECT_EQ(point.integer(0), 3U);
  point.arguments[3] = kNan;
  EXPECT_EQ(check(point), CommandResult::ArgumentOutOfRange);
}

TEST(Commands, RefuseARangeThatEndsBeforeItBegins) {
  EXPECT_EQ(check({CommandCode::SetColourRange, {0, 1, 20, 20.1}}), CommandResult::Done);
  for (const double last : {20.0, 19.0}) {
    const Command command{CommandCode::SetColourRange, {0, 1, 20, last}};
    EXPECT_EQ(check(command), CommandResult::ArgumentOutOfRange);
    EXPECT_EQ(refusal_text(command),
              "first is 20; it must be below last, which is " + std::to_string(int(last)));
  }
}

TEST(Commands, NameEveryColourMap) {
  std::string names;
  for (std::size_t map = 0; map < kColourMapNames.size(); ++map) {
    names += (map == 0 ? "" : ", ") + std::to_string(map) + " " + std::string(kColourMapNames[map]);
  }
  const ArgumentInfo& argument = find_command(CommandCode::SetColourMap)->arguments[2];
  EXPECT_EQ(argument.description, names);
  EXPECT_EQ(argument.maximum, kColourMapNames.size() - 1);
}

TEST(Commands, IgnoreArgumentsThatTheyHaveNot) {
  EXPECT_EQ(check({CommandCode::Start, {kNan, -5, kInfinity, 0.5}}), CommandResult::Done);
  EXPECT_EQ(check({CommandCode::Snapshot, {0, kNan, kNan, kNan}}), CommandResult::Done);
}

}  // namespace
}  // namespace orbwatch::app
