// SPDX-License-Identifier: Apache-2.0
// Commands over a real DDS network: their answers, and the number of executions.
#include "app/ports/dds/commands/command_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/topics/topic_names.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "tests/app/ports/dds/commands/command_case.h"
#include "tests/app/ports/dds/figures.h"
#include "tests/app/ports/dds/foreign_writer.h"
#include "tests/app/ports/dds/topic_reader.h"

namespace orbwatch::app::dds {
namespace {

using command_case::command_settings;
using command_case::Controller;
using command_case::Machine;
using command_case::send;
using testing::HasSubstr;
using tests::DdsNetwork;
using tests::eventually;

class CommandServiceTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(network_.valid());
    const auto started = sink_.start();
    ASSERT_TRUE(started) << started.error().message;
  }

  CommandCounts counts() const { return sink_.statistics().commands; }
  std::uint64_t total() const {
    const CommandCounts now = counts();
    return now.done + now.refused + now.repeated + now.dropped;
  }

  DdsNetwork network_;
  Machine machine_;
  DdsSink sink_{command_settings(), {{}, {"front"}, {}}, machine_.handler()};
};

TEST_F(CommandServiceTest, ClientGetsTheAnswerOfTheMachine) {
  const Command point{CommandCode::PointView, {2, -115.5, -40.25, 60}};
  const auto done = send(point, std::chrono::minutes(1));
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(*done, (CommandAnswer{CommandResult::Done, "done"}));
  ASSERT_EQ(machine_.count(), 1u) << "the client's repetitions repeat no command";
  EXPECT_EQ(machine_.commands()[0].code, CommandCode::PointView);
  EXPECT_EQ(machine_.commands()[0].arguments, point.arguments);

  const auto refused = send({CommandCode::SelectView, {7}}, std::chrono::minutes(1));
  ASSERT_TRUE(refused) << refused.error().message;
  EXPECT_EQ(refused->result, CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(refused->text, "argument out of range");
  EXPECT_EQ(machine_.count(), 2u);
  EXPECT_EQ(counts().done, 1u);
  EXPECT_EQ(counts().refused, 1u);
}

TEST_F(CommandServiceTest, CountsWhatIsNoRequestAtAll) {
  // Announced as a command, but its bytes state a length of characters that are missing.
  dds_topic_descriptor_t type = builtin_interfaces_msg_dds__Time__desc;
  type.m_typename = orbwatch_msgs_msg_dds__Command__desc.m_typename;
  const tests::ForeignWriter writer(DdsNetwork::kReaderDomain, type, command_topic("orbwatch"),
                                    command_qos());
  ASSERT_TRUE(writer.wait_for_reader());
  const auto before = sink_.statistics();
  const TimeMessage sample{-1, 0xFFFFFFFF};
  writer.write(&sample);
  EXPECT_TRUE(eventually([&] { return sink_.statistics().malformed > before.malformed; }));
  EXPECT_EQ(sink_.statistics().commands, before.commands);
}

TEST_F(CommandServiceTest, CountsWhatIsTooLargeToTake) {
  const Controller controller;
  ASSERT_TRUE(controller.connect());
  const auto before = sink_.statistics();
  controller.send({9, 1}, std::string(2'000'000, '%'), {});
  EXPECT_TRUE(eventually([&] { return sink_.statistics().malformed > before.malformed; }));
  EXPECT_EQ(controller.ask({9, 2}, "start", {}).result, CommandResult::Done);
  EXPECT_EQ(counts().done, before.commands.done + 1);
  EXPECT_EQ(counts().refused, before.commands.refused);
}

TEST_F(CommandServiceTest, CarriesEachRequestOutOnce) {
  const Controller controller;
  ASSERT_TRUE(controller.connect());
  EXPECT_EQ(controller.ask({77, 5}, "start", {}).result, CommandResult::Done);
  EXPECT_EQ(machine_.count(), 1u);
  EXPECT_EQ(controller.ask({77, 5}, "start", {}), (CommandAnswer{CommandResult::Done, "done"}));
  EXPECT_EQ(controller.ask({77, 5}, "stop", {}).result, CommandResult::Done)
      << "the id names the request, whatever else it says";
  EXPECT_EQ(machine_.count(), 1u);

  EXPECT_EQ(controller.ask({77, 6}, "select_view", {3}).result, CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(controller.ask({77, 6}, "select_view", {0}).result, CommandResult::ArgumentOutOfRange)
      << "the same answer, not another try";
  EXPECT_EQ(machine_.count(), 2u);

  const auto repeated = counts().repeated;
  controller.send({77, 4}, "start", {});
  ASSERT_TRUE(eventually([&] { return counts().repeated > repeated; })) << "late";
  EXPECT_EQ(machine_.count(), 2u);
  EXPECT_EQ(controller.ask({78, 4}, "start", {}).result, CommandResult::Done) << "another client";
  EXPECT_EQ(machine_.count(), 3u);
}

TEST_F(CommandServiceTest, RefusesWhatIsNoCommand) {
  const Controller controller;
  ASSERT_TRUE(controller.connect());
  auto expect_refused = [&, number = std::uint64_t{0}](
                            const std::string& name, const std::vector<double>& arguments,
                            CommandResult result, const std::string& why) mutable {
    const auto before = counts().refused;
    const CommandAnswer answer = controller.ask({5, ++number}, name, arguments);
    EXPECT_EQ(answer.result, result) << name.substr(0, 80);
    EXPECT_THAT(answer.text, HasSubstr(why));
    EXPECT_EQ(counts().refused, before + 1) << name.substr(0, 80);
  };
  constexpr auto kRange = CommandResult::ArgumentOutOfRange;
  expect_refused("explode", {}, CommandResult::UnknownCommand, "unknown command");
  expect_refused(std::string(100'000, '%'), {}, CommandResult::UnknownCommand, "unknown command");
  expect_refused("select_recipe", {std::nan("")}, kRange, "recipe is nan");
  expect_refused("select_recipe", {}, kRange, "takes 1 argument: recipe");
  expect_refused("select_recipe", std::vector<double>(10'000, 1.0), kRange, "takes 1 argument");
  EXPECT_EQ(controller.ask({0, 0}, "start", {}).result, kRange);
  EXPECT_EQ(machine_.count(), 0u);
}

TEST_F(CommandServiceTest, CountsEveryRequestOfAFloodAndLimitsWhatIsCarriedOut) {
  const Controller controller;
  ASSERT_TRUE(controller.connect());
  constexpr std::uint64_t kSent = 3000;
  const auto begin = hal::Clock::now();
  for (std::uint64_t number = 1; number <= kSent; ++number) {
    controller.send({9, number}, "trigger", {});
    // At most as many as the writer itself keeps.
    if (number % 100 == 0) {
      ASSERT_TRUE(controller.requests().flush());
    }
  }
  ASSERT_TRUE(eventually([&] { return total() >= kSent; }));
  const std::chrono::duration<double> took = hal::Clock::now() - begin;
  EXPECT_EQ(total(), kSent) << "no request without a count";
  EXPECT_EQ(counts().done, machine_.count());
  EXPECT_GT(counts().done, 0u);
  EXPECT_LE(static_cast<double>(counts().done),
            CommandService::kMaxPerSecond * (std::ceil(took.count()) + 1));
  EXPECT_GT(counts().refused + counts().dropped, 0u);
  EXPECT_EQ(counts().repeated, 0u);

  // Afterwards a regular client is served as soon as the second is over.
  EXPECT_TRUE(eventually([&] {
    const auto answer = send({CommandCode::Start, {}}, std::chrono::minutes(1));
    return answer && answer->result == CommandResult::Done;
  }));
}

TEST_F(CommandServiceTest, RequestsOfBeforeAreNotForWhoComesLater) {
  sink_.stop();
  const Controller controller;
  controller.send({3, 1}, "start", {});
  ASSERT_TRUE(sink_.start());
  ASSERT_TRUE(controller.connect());
  EXPECT_EQ(controller.ask({3, 2}, "stop", {}).result, CommandResult::Done);
  ASSERT_EQ(machine_.count(), 1u);
  EXPECT_EQ(machine_.commands()[0].code, CommandCode::Stop);
}

TEST_F(CommandServiceTest, RememberedOverAStopAndStart) {
  {
    const Controller controller;
    ASSERT_TRUE(controller.connect());
    EXPECT_EQ(controller.ask({3, 1}, "start", {}).result, CommandResult::Done);
  }
  sink_.stop();
  ASSERT_TRUE(sink_.start());
  const Controller controller;
  ASSERT_TRUE(controller.connect());
  EXPECT_EQ(controller.ask({3, 1}, "start", {}).result, CommandResult::Done);
  EXPECT_EQ(machine_.count(), 1u);
}

TEST_F(CommandServiceTest, CountersAreInTheState) {
  const Controller controller;
  ASSERT_TRUE(controller.connect());
  EXPECT_EQ(controller.ask({3, 1}, "start", {}).result, CommandResult::Done);
  EXPECT_EQ(controller.ask({3, 2}, "explode", {}).result, CommandResult::UnknownCommand);
  const tests::TopicReader<ProcessStateMessage> states(
      orbwatch_msgs_msg_dds__ProcessState__desc, process_state_topic("orbwatch"), state_qos());
  ASSERT_TRUE(eventually([&] {
    sink_.accept(Status{});
    CommandCounts seen;
    states.take([&](const ProcessStateMessage& state) {
      const ComponentMessage commands = tests::of_kind(state, "commands").at(0);
      const auto count = [&](std::string_view name) {
        return static_cast<std::uint64_t>(tests::value(commands, name));
      };
      seen = {count("done"), count("refused"), count("repeated"), count("dropped")};
    });
    return seen.done == 1 && seen.refused == 1 && seen == counts();
  }));
}

/// Handler of commands that takes until end(), like a slow disk.
class SlowMachine {
 public:
  CommandHandler handler() {
    return [this](const Command&) {
      has_begun_ = true;
      has_ended_.wait(false);
      return CommandResult::Done;
    };
  }
  bool has_begun() const { return has_begun_; }
  void end() {
    has_ended_ = true;
    has_ended_.notify_all();
  }

 private:
  std::atomic<bool> has_begun_{false}, has_ended_{false};
};

class SlowCommand : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(network_.valid());
    ASSERT_TRUE(sink_.start());
  }
  ~SlowCommand() override { machine_.end(); }

  void measure(std::uint64_t frame_set, std::uint64_t result) {
    Status status;
    status.frame_set = frame_set;
    status.result = result;
    status.stamp = hal::Clock::now();
    sink_.accept(status);
  }

  DdsNetwork network_;
  SlowMachine machine_;
  DdsSink sink_{command_settings(), {{}, {"front"}, {}}, machine_.handler()};
};

dds::Qos every_state() {
  dds::Qos qos = state_qos();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 100);
  return qos;
}

TEST_F(SlowCommand, DelaysNoStateAndLeavesEachResultItsFrameSet) {
  const Controller controller;
  ASSERT_TRUE(controller.connect());
  const tests::TopicReader<ProcessStateMessage> states(
      orbwatch_msgs_msg_dds__ProcessState__desc, process_state_topic("orbwatch"), every_state());
  bool has_states = false;
  ASSERT_TRUE(eventually([&] {
    controller.send({7, 1}, "trigger", {});
    measure(10, 0);
    has_states |= states.take([](const auto&) {});
    return has_states && machine_.has_begun();
  }));
  for (const std::uint64_t frame_set : {11, 12, 13}) measure(frame_set, frame_set == 11 ? 1 : 2);
  measure(14, 2);
  using Seen = std::pair<std::uint64_t, std::uint64_t>;  // frame set and result
  std::vector<Seen> changes{{0, 0}};
  std::uint64_t frame_set = 0;
  ASSERT_TRUE(eventually([&] {
    states.take([&](const ProcessStateMessage& state) {
      frame_set = state.frame_set;
      if (state.result != changes.back().second) changes.emplace_back(frame_set, state.result);
    });
    return frame_set == 14;
  })) << "while the command is executed";
  EXPECT_THAT(changes, testing::ElementsAre(Seen{0, 0}, Seen{11, 1}, Seen{12, 2}));
  machine_.end();
  EXPECT_EQ(controller.ask({7, 1}, "trigger", {}).result, CommandResult::Done);
}

/// Expects that this sink has no reader for commands.
void expect_deaf(const DdsSettings& settings, CommandHandler handler) {
  const DdsNetwork network;
  ASSERT_TRUE(network.valid());
  DdsSink sink(settings, {{}, {"front"}, {}}, std::move(handler));
  ASSERT_TRUE(sink.start());
  const auto answer = send({CommandCode::Start, {}}, std::chrono::seconds(1));
  ASSERT_FALSE(answer);
  EXPECT_THAT(answer.error().message, HasSubstr("nobody accepts commands on rt/orbwatch/command"));
}

TEST(CommandServiceOffTest, NobodyTakesCommandsWhenSwitchedOff) {
  Machine machine;
  DdsSettings off = command_settings();
  off.commands = false;
  expect_deaf(off, machine.handler());
  EXPECT_EQ(machine.count(), 0u);
}

TEST(CommandServiceOffTest, NobodyTakesCommandsUnlessTheyAreAskedFor) {
  Machine machine;
  expect_deaf({.domain = DdsNetwork::kSinkDomain}, machine.handler());
  EXPECT_EQ(machine.count(), 0u);
}

TEST(CommandServiceOffTest, SecurityAsksForThemToo) {
  DdsSettings dds;
  EXPECT_FALSE(takes_commands(dds));
  EXPECT_EQ(commanders(dds), "");
  dds.commands = true;
  EXPECT_EQ(commanders(dds), "over DDS from every participant of domain 0");
  dds.commands.reset();
  dds.security.emplace();
  EXPECT_TRUE(takes_commands(dds));
  EXPECT_EQ(commanders(dds), "over DDS from holders of keys");
  dds.commands = false;
  EXPECT_FALSE(takes_commands(dds));
}

TEST(CommandServiceOffTest, NobodyTakesCommandsWithoutAHandler) {
  expect_deaf(command_settings(), nullptr);
}

TEST(CommandClientTest, RefusesAnAnswerThatNobodyKnows) {
  const DdsNetwork network;
  ASSERT_TRUE(network.valid());
  // A service that answers every request with the invalid number 999.
  const tests::ForeignWriter results(DdsNetwork::kSinkDomain,
                                     orbwatch_msgs_msg_dds__CommandResult__desc,
                                     command_result_topic("orbwatch"), command_qos());
  auto participant = Participant::join(DdsNetwork::kSinkDomain);
  ASSERT_TRUE(participant);
  TopicReader requests(orbwatch_msgs_msg_dds__Command__desc, command_topic("orbwatch"));
  ASSERT_TRUE(requests.open(participant->entity(), command_qos()));
  const auto wait_set = make_wait_set(participant->entity(), {requests.get()});
  ASSERT_TRUE(wait_set);
  std::atomic<bool> ended{false};
  std::thread service([&] {
    while (!ended) {
      const auto look = [&](const void* sample, const dds_sample_info_t&) {
        const auto& request = *static_cast<const CommandMessage*>(sample);
        std::string text = "?";
        const CommandResultMessage answer{request.client, request.number, 999, text.data()};
        results.write(&answer);
      };
      EXPECT_TRUE(wait_for_data(*wait_set, std::chrono::milliseconds(20)));
      EXPECT_TRUE(take_samples(requests.get(), look));
    }
  });
  const auto answer = send({CommandCode::Start, {}}, std::chrono::minutes(1));
  ended = true;
  service.join();
  ASSERT_FALSE(answer);
  EXPECT_THAT(answer.error().message, HasSubstr("999"));
}

}  // namespace
}  // namespace orbwatch::app::dds
