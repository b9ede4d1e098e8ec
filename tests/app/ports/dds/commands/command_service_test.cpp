// SPDX-License-Identifier: Apache-2.0
// Commands over a real DDS network: their answers, and the number of executions.
#include "app/ports/dds/commands/command_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "app/cli/dds/command_client.h"
#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/topics/topic_names.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "tests/app/ports/dds/figures.h"
#include "tests/app/ports/dds/foreign_writer.h"
#include "tests/app/ports/dds/topic_reader.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::dds {
namespace {

using testing::HasSubstr;
using tests::DdsNetwork;
using tests::eventually;

/// Handler of the sink's commands, which refuses everything except view 0.
class Machine {
 public:
  CommandHandler handler() {
    return [this](const Command& command) {
      const std::lock_guard lock(mutex_);
      commands_.push_back(command);
      return command.code == CommandCode::SelectView && command.integer(0) > 0
                 ? CommandResult::ArgumentOutOfRange
                 : CommandResult::Done;
    };
  }
  std::vector<Command> commands() const {
    const std::lock_guard lock(mutex_);
    return commands_;
  }
  std::size_t count() const { return commands().size(); }

 private:
  mutable std::mutex mutex_;
  std::vector<Command> commands_;
};

/// A controller that sends any message and reads all results.
class Controller {
 public:
  Controller()
      : requests_(DdsNetwork::kReaderDomain, orbwatch_msgs_msg_dds__Command__desc,
                  command_topic("orbwatch"), command_qos()),
        results_(orbwatch_msgs_msg_dds__CommandResult__desc, command_result_topic("orbwatch"),
                 command_qos()) {}

  bool connect() const {
    return requests_.wait_for_reader() && eventually([this] {
             dds_subscription_matched_status_t matched{};
             return dds_get_subscription_matched_status(results_.get(), &matched) ==
                        DDS_RETCODE_OK &&
                    matched.current_count > 0;
           });
  }

  void send(RequestId id, std::string name, std::vector<double> arguments) const {
    const auto count = static_cast<std::uint32_t>(arguments.size());
    const CommandMessage message{
        id.client, id.number, name.data(), {count, count, arguments.data(), false}};
    requests_.write(&message);
  }

  /// Sends until an answer to this request arrives; the first one may be written before the sink
  /// has matched this reader.
  CommandAnswer ask(RequestId id, const std::string& name,
                    const std::vector<double>& arguments) const {
    CommandAnswer answer{CommandResult::Busy, "no answer"};
    EXPECT_TRUE(eventually([&] {
      send(id, name, arguments);
      bool answered = false;
      results_.take([&](const CommandResultMessage& message) {
        if (RequestId{message.client, message.number} != id) return;
        answer = {static_cast<CommandResult>(message.result), message.text};
        answered = true;
      });
      return answered;
    }));
    return answer;
  }

  const tests::ForeignWriter& requests() const { return requests_; }

 private:
  tests::ForeignWriter requests_;
  tests::TopicReader<CommandResultMessage> results_;
};

DdsSettings command_settings() { return {.domain = DdsNetwork::kSinkDomain, .commands = true}; }

/// A sink whose record of commands is in a folder.
class RecordedCommands : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(network_.valid()); }

  /// Stops the previous sink and starts one; the controller has none of its answers.
  void start(const std::filesystem::path& folder, CommandHandler handler) {
    sink_.reset();
    controller_.emplace();
    sink_.emplace(command_settings(), StatusNames{{}, {"front"}, {}}, std::move(handler),
                  network_addresses, std::make_shared<CommandRecord>(folder));
    const auto started = sink_->start();
    ASSERT_TRUE(started) << started.error().message;
    ASSERT_TRUE(controller_->connect());
  }

  DdsNetwork network_;
  const orbwatch::tests::TemporaryFolder folder_;
  Machine machine_;
  std::optional<Controller> controller_;
  std::optional<DdsSink> sink_;
};

TEST_F(RecordedCommands, ARestartRepeatsNoRequest) {
  start(folder_.path(), machine_.handler());
  EXPECT_EQ(controller_->ask({7, 3}, "select_view", {0}).result, CommandResult::Done);
  start(folder_.path(), machine_.handler());
  EXPECT_EQ(controller_->ask({7, 3}, "select_view", {0}),
            (CommandAnswer{CommandResult::Done, "done"}));
  EXPECT_EQ(machine_.count(), 1U);
  EXPECT_EQ(controller_->ask({7, 4}, "select_view", {5}).result, CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(machine_.count(), 2U);
}

TEST_F(RecordedCommands, OneThatWasCutOffIsInterrupted) {
  const orbwatch::tests::TemporaryFolder then;
  start(folder_.path(), [&](const Command&) {
    // Copies the disk's content as after a power failure now.
    std::filesystem::copy(folder_.path(), then.path(), std::filesystem::copy_options::recursive);
    return CommandResult::Done;
  });
  EXPECT_EQ(controller_->ask({7, 3}, "select_view", {0}).result, CommandResult::Done);
  start(then.path(), machine_.handler());
  EXPECT_EQ(controller_->ask({7, 3}, "select_view", {0}).result, CommandResult::Interrupted);
  EXPECT_EQ(machine_.count(), 0U);
}

TEST_F(RecordedCommands, WithoutAFolderTheFirstOfAClientIsNotCarriedOut) {
  start("/proc/orbwatch", machine_.handler());
  EXPECT_EQ(controller_->ask({7, 3}, "select_view", {0}).result, CommandResult::NotCarriedOut);
  EXPECT_EQ(machine_.count(), 0U);
  EXPECT_EQ(controller_->ask({7, 4}, "select_view", {0}).result, CommandResult::Done);
  EXPECT_EQ(machine_.count(), 1U);
}

Result<CommandAnswer> send(const Command& command, std::chrono::milliseconds timeout) {
  const std::atomic<bool> cancelled{false};
  return cli::send_command({.domain = DdsNetwork::kReaderDomain, .timeout = timeout}, command,
                           cancelled);
}

TEST_F(RecordedCommands, TheCommandLineSendsAgainWhatWasNotCarriedOut) {
  start("/proc/orbwatch", machine_.handler());
  // The count is higher if the request was repeated before the answer arrived.
  EXPECT_TRUE(eventually([&] {
    const auto answer = send({CommandCode::Start, {}}, std::chrono::minutes(1));
    return answer && answer->result == CommandResult::Done;
  }));
  EXPECT_EQ(machine_.count(), 1U);
}

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
