// SPDX-License-Identifier: Apache-2.0
/// Commands of a PLC that writes its block cyclically, across restarts of the server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <latch>
#include <mutex>
#include <optional>
#include <utility>

#include "tests/app/ports/modbus/clients.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

using orbwatch::tests::TemporaryFolder;
using testing::ElementsAre;
using tests::kAcknowledged;
using tests::kArguments;
using tests::loopback;
using tests::Plc;
using tests::select_view;
using tests::Words;

constexpr auto kInterrupted = static_cast<std::uint16_t>(CommandResult::Interrupted);
constexpr auto kNotCarriedOut = static_cast<std::uint16_t>(CommandResult::NotCarriedOut);

class CommandRestart : public testing::Test {
 protected:
  /// Starts a server whose record is in `folder`; stops the previous one.
  Plc start(const std::filesystem::path& folder) {
    sink_.reset();
    sink_.emplace(
        loopback(), [this](const Command& command) { return carry_out(command); },
        std::make_shared<CommandRecord>(folder));
    const auto started = sink_->start();
    EXPECT_TRUE(started) << started.error().message;
    return Plc(sink_->port());
  }
  CommandResult carry_out(const Command& command) {
    if (on_command_) on_command_();
    const std::lock_guard lock(mutex_);
    views_.push_back(static_cast<int>(command.arguments[0]));
    return CommandResult::Done;
  }
  std::vector<int> views() {
    const std::lock_guard lock(mutex_);
    return views_;
  }
  /// Acknowledged sequence, result and last command.
  Words answer(Plc& plc) const {
    EXPECT_EQ(plc.read_holding(kAcknowledged, 3), 0);
    return plc.words;
  }

  const TemporaryFolder folder_;
  std::function<void()> on_command_;
  std::mutex mutex_;
  std::vector<int> views_;
  std::optional<ModbusSink> sink_;
};

TEST_F(CommandRestart, TheStandingBlockRepeatsNothing) {
  Plc plc = start(folder_.path());
  ASSERT_EQ(plc.command(kArguments, select_view(5, 700)), 0);
  for (int restart = 0; restart < 3; ++restart) {
    Plc again = start(folder_.path());
    EXPECT_EQ(answer(again), (Words{700, 0, 1})) << "before it writes";
    for (int cycle = 0; cycle < 3; ++cycle)
      ASSERT_EQ(again.write(kArguments, select_view(5, 700)), 0);
    EXPECT_EQ(answer(again), (Words{700, 0, 1}));
  }
  sink_->stop();  // executes waiting commands
  EXPECT_THAT(views(), ElementsAre(5));
}

TEST_F(CommandRestart, WhatWasWrittenMeanwhileIsCarriedOut) {
  Plc plc = start(folder_.path());
  ASSERT_EQ(plc.command(kArguments, select_view(5, 700)), 0);
  Plc again = start(folder_.path());
  ASSERT_EQ(again.command(kArguments, select_view(6, 701)), 0);
  EXPECT_EQ(answer(again), (Words{701, 0, 1}));
  EXPECT_THAT(views(), ElementsAre(5, 6));
}

TEST_F(CommandRestart, OneThatWasCutOffIsInterrupted) {
  const TemporaryFolder then;
  on_command_ = [&] {
    // Copies the disk's content as after a power failure now.
    std::filesystem::copy(folder_.path(), then.path(), std::filesystem::copy_options::recursive);
  };
  Plc plc = start(folder_.path());
  ASSERT_EQ(plc.command(kArguments, select_view(5, 700)), 0);
  Plc again = start(then.path());
  ASSERT_EQ(again.write(kArguments, select_view(5, 700)), 0);
  EXPECT_EQ(answer(again), (Words{700, kInterrupted, 1}));
  on_command_ = nullptr;
  ASSERT_EQ(again.command(kArguments, select_view(5, 701)), 0);
  EXPECT_EQ(answer(again), (Words{701, 0, 1}));
  EXPECT_THAT(views(), ElementsAre(5, 5));
}

TEST_F(CommandRestart, WithoutAFolderTheFirstSequenceIsTakenAsKnown) {
  for (std::uint16_t sequence = 700; sequence < 706; sequence += 2) {
    Plc plc = start("/proc/orbwatch");
    ASSERT_EQ(plc.command(kArguments, select_view(sequence, sequence)), 0);
    EXPECT_EQ(answer(plc), (Words{sequence, kNotCarriedOut, 1}));
    const auto next = static_cast<std::uint16_t>(sequence + 1);
    ASSERT_EQ(plc.command(kArguments, select_view(next, next)), 0);
    EXPECT_EQ(answer(plc), (Words{next, 0, 1}));
  }
  EXPECT_THAT(views(), ElementsAre(701, 703, 705));
}

TEST_F(CommandRestart, NoOtherAnswerWaitsForACommand) {
  std::latch begun(1), finished(1);
  on_command_ = [&, is_first = true]() mutable {
    if (!std::exchange(is_first, false)) return;
    begun.count_down();
    finished.wait();
  };
  Plc plc = start(folder_.path());
  ASSERT_EQ(plc.write(kArguments, select_view(5, 700)), 0);
  begun.wait();
  Plc reader(sink_->port());
  EXPECT_EQ(reader.read_input(0, 100), 0);
  EXPECT_EQ(answer(plc), (Words{0, 0, 0})) << "nothing is acknowledged yet";
  // The last command written over the present one is executed next.
  ASSERT_EQ(plc.write(kArguments, select_view(6, 701)), 0);
  ASSERT_EQ(plc.write(kArguments, select_view(7, 702)), 0);
  finished.count_down();
  ASSERT_EQ(plc.command(kArguments, select_view(7, 702)), 0);
  EXPECT_THAT(views(), ElementsAre(5, 7));
}

}  // namespace
}  // namespace orbwatch::app
