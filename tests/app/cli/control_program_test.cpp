// SPDX-License-Identifier: Apache-2.0
/// Runs `orbwatch state` and `orbwatch command` like a user, against a running sink.
#include <gmock/gmock.h>

#include <chrono>
#include <functional>
#include <mutex>
#include <sstream>
#include <thread>

#include "app/ports/dds/dds_sink.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"
#include "tests/app/cli/equal_json.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/support/loopback_dds.h"

namespace orbwatch::tests {
namespace {

using app::Command;
using app::CommandCode;
using app::CommandResult;
using testing::HasSubstr;

class Control : public CommandLine {
 protected:
  Control() { setenv("CYCLONEDDS_URI", loopback_dds().c_str(), 1); }

  void SetUp() override {
    const auto started = sink.start();
    ASSERT_TRUE(started) << started.error().message;
  }

  /// Runs a subcommand in the domain of the sink.
  int ask(const std::string& subcommand, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {subcommand, "--domain", std::to_string(domain), "--timeout", "60"});
    return run(arguments);
  }

  CommandResult carry_out(const Command& command) {
    const std::lock_guard lock(mutex);
    commands.push_back(command);
    return command.code == CommandCode::SelectRecipe && command.arguments[0] == 2
               ? CommandResult::Done
               : CommandResult::NotPossible;
  }
  std::vector<Command> carried_out() {
    const std::lock_guard lock(mutex);
    return commands;
  }

  const int domain = 1 + getpid() % 100;
  std::mutex mutex;
  std::vector<Command> commands;
  app::dds::DdsSink sink{{.domain = domain, .commands = true},
                         app::tests::make_names(),
                         [this](const Command& command) { return carry_out(command); }};
};

TEST_F(Control, CommandEndsWithWhatTheMachineSays) {
  EXPECT_EQ(ask("command", {"select_recipe", "2"}), 0) << said;
  EXPECT_EQ(said, "");
  EXPECT_EQ(ask("command", {"point_view", "2", "-115", "-40", "60"}), 1);
  EXPECT_EQ(said, "orbwatch: point_view: not possible with this configuration\n");
  const auto carried = carried_out();
  ASSERT_EQ(carried.size(), 2U);
  EXPECT_EQ(carried[0].code, CommandCode::SelectRecipe);
  EXPECT_EQ(carried[1].code, CommandCode::PointView);
  EXPECT_THAT(carried[1].arguments, testing::ElementsAre(2, -115, -40, 60));
}

TEST_F(Control, WrongCommandsAreNotSent) {
  expect_refused("command", {"Nothing", {}, {"say which command", "--help"}});
  expect_refused("command", {"Name", {"explode"}, {"no command explode"}});
  expect_refused("command", {"Range", {"select_recipe", "0"}, {"recipe is 0", "1 to 65535"}});
  expect_refused("command", {"Option", {"--json", "start"}, {"--json"}});
  expect_refused("command", {"Timeout", {"--timeout", "0", "start"}, {"--timeout must be above"}});
  expect_refused("command", {"Domain", {"--domain", "231", "start"}, {"--domain is 231"}});
  EXPECT_TRUE(carried_out().empty());
}

TEST_F(Control, SilenceIsAnError) {
  sink.stop();
  EXPECT_EQ(run({"command", "--domain", std::to_string(domain), "--timeout", "0.5", "start"}), 1);
  EXPECT_THAT(said, HasSubstr("nobody accepts commands on rt/orbwatch/command"));
  EXPECT_EQ(run({"state", "--domain", std::to_string(domain), "--timeout", "0.5"}), 1);
  EXPECT_THAT(said, HasSubstr("nothing on rt/orbwatch/process_state"));
}

TEST_F(Control, StateIsPrintedForPeopleAndForPrograms) {
  const app::Status status = app::tests::make_status();
  sink.accept(status);
  EXPECT_EQ(ask("state", {}), 0) << said;
  EXPECT_THAT(said, HasSubstr("state                   degraded"));
  EXPECT_THAT(said, HasSubstr("  region"));
  EXPECT_THAT(said, HasSubstr("weld"));
  EXPECT_EQ(ask("state", {"--json"}), 0) << said;
  expect_equal_json(said, said);
  EXPECT_THAT(said, HasSubstr("\"heartbeat\":" + std::to_string(status.heartbeat)));
  expect_refused("state", {"Argument", {"now"}, {"unexpected argument now"}});
}

TEST_F(Control, TheStateIsDocumented) {
  sink.accept(app::tests::make_status());
  ASSERT_EQ(ask("state", {"--json"}), 0) << said;
  nlohmann::json top;  // the nested figures are those of the appliance
  const auto state = parsed(said);
  for (const auto& [key, value] : state.items()) top[key] = nullptr;
  EXPECT_GT(top.size(), 10U);
  ASSERT_EQ(run({"state", "--help"}), 0);
  expect_documented(top, said);
}

TEST_F(Control, SubscribePrintsObjectsForPrograms) {
  Subprocess subscriber({ORBWATCH_PROGRAM, "subscribe", "--topic", "orbwatch/process_state",
                         "--stats", "--each", "--json", "--domain", std::to_string(domain)},
                        folder.path() / "lines");
  app::Status status = app::tests::make_status();
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  const auto has_both = [&] {
    const std::string text = subscriber.output();
    return text.find("\"samples\"") < text.rfind('\n') &&
           text.find("\"content\"") < text.rfind('\n');
  };
  while (!has_both() && std::chrono::steady_clock::now() < give_up) {
    ++status.heartbeat;
    sink.accept(status);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // polls another process
  }
  subscriber.send(SIGINT);
  ASSERT_EQ(subscriber.wait(), 0) << subscriber.output();
  ASSERT_EQ(run({"subscribe", "--help"}), 0);
  std::istringstream lines(subscriber.output());
  for (std::string line; std::getline(lines, line);) {
    const auto json = parsed(line);
    EXPECT_EQ(json["topic"], "rt/orbwatch/process_state") << line;
    expect_documented(json, said);
  }
  EXPECT_EQ(run({"subscribe", "--json"}), 2);
}

TEST_F(Control, FollowPrintsEachStateUntilItIsEnded) {
  Subprocess follower(
      {ORBWATCH_PROGRAM, "state", "--json", "--follow", "--domain", std::to_string(domain)},
      folder.path() / "states");
  app::Status status = app::tests::make_status();
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  const auto printed = [&] {
    const std::string text = follower.output();
    return std::count(text.begin(), text.end(), '\n');
  };
  while (printed() < 3 && std::chrono::steady_clock::now() < give_up) {
    ++status.heartbeat;
    sink.accept(status);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // polls another process
  }
  EXPECT_GE(printed(), 3) << follower.output();
  follower.send(SIGINT);
  EXPECT_EQ(follower.wait(), 0) << follower.output();
}

}  // namespace
}  // namespace orbwatch::tests
