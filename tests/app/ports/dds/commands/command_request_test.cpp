// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/commands/command_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace orbwatch::app::dds {
namespace {

using testing::HasSubstr;

/// A handler that records its commands and answers `result`.
struct AnsweringMachine {
  CommandResult result = CommandResult::Done;
  std::vector<Command> done{};

  CommandHandler handler() {
    return [this](const Command& command) {
      done.push_back(command);
      return result;
    };
  }
};

CommandRequest request(std::string name, std::vector<double> arguments) {
  CommandRequest request{{1, 2}, std::move(name), {}, arguments.size()};
  std::copy(arguments.begin(), arguments.end(), request.arguments.begin());
  return request;
}

TEST(CarryOut, HandsEveryCommandOverWithItsArguments) {
  for (const CommandInfo& info : kCommands) {
    AnsweringMachine machine;
    CommandRequest asked = request(std::string(info.name), {});
    asked.argument_count = info.argument_count();
    for (std::size_t i = 0; i < asked.argument_count; ++i) {
      asked.arguments[i] = info.arguments[i].maximum;
    }
    EXPECT_EQ(carry_out(asked, machine.handler()), (CommandAnswer{CommandResult::Done, "done"}));
    ASSERT_EQ(machine.done.size(), 1u) << info.name;
    EXPECT_EQ(machine.done[0].code, info.code);
    EXPECT_EQ(machine.done[0].arguments, asked.arguments);
    EXPECT_EQ(machine.done[0].giver.name(), "over DDS");
  }
}

TEST(CarryOut, SaysWhatTheMachineSays) {
  AnsweringMachine machine{CommandResult::NotPossible};
  EXPECT_EQ(carry_out(request("start", {}), machine.handler()),
            (CommandAnswer{CommandResult::NotPossible, "not possible with this configuration"}));
}

TEST(CarryOut, RefusesWhatIsNoCommandAndTouchesNothing) {
  AnsweringMachine machine;
  const auto expect_refused = [&](const CommandRequest& asked, CommandResult result,
                                  const std::string& why) {
    const CommandAnswer answer = carry_out(asked, machine.handler());
    EXPECT_EQ(answer.result, result) << why;
    EXPECT_THAT(answer.text, HasSubstr(why));
  };
  constexpr auto kRange = CommandResult::ArgumentOutOfRange;
  expect_refused(request("explode", {}), CommandResult::UnknownCommand, "unknown command");
  expect_refused(request("", {}), CommandResult::UnknownCommand, "unknown command");
  expect_refused(request("point_view", {1, 2}), kRange,
                 "point_view takes 4 arguments: view yaw pitch h_fov");
  expect_refused(request("start", {1}), kRange, "start takes 0 arguments");
  expect_refused(request("point_view", {0, 200, 0, 60}), kRange,
                 "yaw is 200; it must be -180 to 180 deg");
  expect_refused(request("select_recipe", {1.5}), kRange,
                 "recipe is 1.5; it must be a whole number, 1 to 65535");
  expect_refused(request("select_view", {std::nan("")}), kRange, "view is nan");
  expect_refused(request("select_view", {HUGE_VAL}), kRange, "view is inf");
  for (const RequestId id : {RequestId{0, 1}, RequestId{1, 0}}) {
    CommandRequest nameless = request("start", {});
    nameless.id = id;
    expect_refused(nameless, kRange, "must not be 0");
  }
  EXPECT_TRUE(machine.done.empty());
}

TEST(RequestOf, TakesOverWhatFits) {
  std::string name = "point_view";
  std::vector<double> arguments{2, -115, -40, 60};
  const CommandMessage message{5, 6, name.data(), {4, 4, arguments.data(), false}};
  const CommandRequest taken = request_of(message);
  EXPECT_EQ(taken.id, (RequestId{5, 6}));
  EXPECT_EQ(taken.name, name);
  EXPECT_EQ(taken.argument_count, 4u);
  EXPECT_THAT(taken.arguments, testing::ElementsAreArray(arguments));
}

TEST(RequestOf, CutsWhatIsOversizedSoThatItIsRefused) {
  AnsweringMachine machine;
  std::string name = "stop" + std::string(1'000'000, 'p');
  const CommandMessage long_name{5, 6, name.data(), {0, 0, nullptr, false}};
  EXPECT_LT(request_of(long_name).name.size(), 100u);
  EXPECT_EQ(carry_out(request_of(long_name), machine.handler()).result,
            CommandResult::UnknownCommand);

  std::string longest = "set_process_active";  // would be a command if cut here
  std::string longer = longest + "x";
  const CommandMessage one_more{5, 6, longer.data(), {0, 0, nullptr, false}};
  EXPECT_EQ(carry_out(request_of(one_more), machine.handler()).result,
            CommandResult::UnknownCommand);

  std::string point = "point_view";
  std::vector<double> arguments(1'000'000, 0.0);
  const CommandMessage many{5, 6, point.data(), {1'000'000, 1'000'000, arguments.data(), false}};
  EXPECT_EQ(carry_out(request_of(many), machine.handler()).result,
            CommandResult::ArgumentOutOfRange);
  EXPECT_TRUE(machine.done.empty());
}

}  // namespace
}  // namespace orbwatch::app::dds
