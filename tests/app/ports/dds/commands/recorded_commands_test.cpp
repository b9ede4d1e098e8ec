// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "tests/app/ports/dds/commands/command_case.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::dds {
namespace {

using command_case::command_settings;
using command_case::Controller;
using command_case::Machine;
using command_case::send;
using tests::DdsNetwork;
using tests::eventually;

/// A sink whose record of commands is in a folder.
class RecordedCommands : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(network_.valid()); }

  /// Stops the previous sink and starts one; the controller has none of its answers.
  void start(const std::filesystem::path& folder, CommandHandler handler) {
    sink_.reset();
    record_.reset();  // its folder is locked until then
    record_ = std::make_shared<CommandRecord>(folder);
    controller_.emplace();
    sink_.emplace(command_settings(), StatusNames{{}, {"front"}, {}}, std::move(handler),
                  network_addresses, record_);
    const auto started = sink_->start();
    ASSERT_TRUE(started) << started.error().message;
    ASSERT_TRUE(controller_->connect());
  }

  DdsNetwork network_;
  const orbwatch::tests::TemporaryFolder folder_;
  Machine machine_;
  std::shared_ptr<CommandRecord> record_;
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

TEST_F(RecordedCommands, EachWaitsOnceForTheAuditHoweverOftenItIsSent) {
  start(folder_.path(), machine_.handler());
  const CommandId id{7, 3};
  for (int sent = 0; sent < 2; ++sent) {
    EXPECT_EQ(controller_->ask(id, "select_view", {5}).result, CommandResult::ArgumentOutOfRange);
  }
  const auto waiting = record_->take_unaudited();
  ASSERT_TRUE(waiting);
  EXPECT_EQ(waiting->id, id);
  EXPECT_EQ(waiting->command.code, CommandCode::SelectView);
  EXPECT_EQ(waiting->command.arguments[0], 5);
  EXPECT_EQ(waiting->command.giver.name(), "over DDS");
  EXPECT_EQ(waiting->result, CommandResult::ArgumentOutOfRange);
  EXPECT_FALSE(record_->take_unaudited());
}

TEST_F(RecordedCommands, WithoutAFolderTheFirstOfAClientIsNotCarriedOut) {
  start("/proc/orbwatch", machine_.handler());
  EXPECT_EQ(controller_->ask({7, 3}, "select_view", {0}).result, CommandResult::NotCarriedOut);
  EXPECT_EQ(machine_.count(), 0U);
  EXPECT_EQ(controller_->ask({7, 4}, "select_view", {0}).result, CommandResult::Done);
  EXPECT_EQ(machine_.count(), 1U);
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

}  // namespace
}  // namespace orbwatch::app::dds
