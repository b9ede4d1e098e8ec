// SPDX-License-Identifier: Apache-2.0
#include "app/state/command_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>
#include <thread>

#include "tests/app/state/damaged_disk.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tests::FullDisk;
using Entry = CommandRecord::Entry;

constexpr Command kStop{CommandCode::Stop, {}};
constexpr std::uint16_t kStopCode = 4;

class CommandRecordTest : public testing::Test {
 protected:
  std::unique_ptr<CommandRecord> open() const {
    return std::make_unique<CommandRecord>(folder_.path());
  }
  CommandResult carry_out(CommandRecord& record, const CommandId& id) {
    return record.carry_out(id, kStop, [&](const Command&) {
      carried_out_.push_back(id.number);
      return CommandResult::Done;
    });
  }

  const orbwatch::tests::TemporaryFolder folder_;
  std::vector<std::uint64_t> carried_out_;
};

TEST_F(CommandRecordTest, IsEmptyOnANewAppliance) {
  const auto record = open();
  EXPECT_TRUE(record->is_kept());
  EXPECT_THAT(record->entries(), IsEmpty());
  EXPECT_EQ(carry_out(*record, {kPlcClient, 7}), CommandResult::Done);
  EXPECT_THAT(carried_out_, ElementsAre(7));
}

TEST_F(CommandRecordTest, KeepsTheNewestCommandOfEachClient) {
  auto record = open();
  for (const CommandId& id :
       {CommandId{kPlcClient, 7}, CommandId{1, 1}, CommandId{1, 2}, CommandId{kPlcClient, 8}}) {
    carry_out(*record, id);
  }
  record.reset();
  EXPECT_THAT(open()->entries(),
              ElementsAre(Entry{{1, 2}, kStopCode, CommandResult::Done},
                          Entry{{kPlcClient, 8}, kStopCode, CommandResult::Done}));
}

TEST_F(CommandRecordTest, NotesTheCommandBeforeItIsCarriedOutAndItsResultBeforeThatIsTold) {
  const auto on_disk = [&] {
    const orbwatch::tests::TemporaryFolder other;
    std::filesystem::copy(folder_.path(), other.path(),
                          std::filesystem::copy_options::recursive |
                              std::filesystem::copy_options::overwrite_existing);
    return CommandRecord(other.path()).entries();
  };
  const auto record = open();
  record->carry_out({kPlcClient, 7}, kStop, [&](const Command&) {
    EXPECT_THAT(on_disk(),
                ElementsAre(Entry{{kPlcClient, 7}, kStopCode, CommandResult::Interrupted}));
    return CommandResult::Busy;
  });
  EXPECT_THAT(on_disk(), ElementsAre(Entry{{kPlcClient, 7}, kStopCode, CommandResult::Busy}));
}

TEST_F(CommandRecordTest, KeepsWhatWasSelectedForThisProcessOnly) {
  const auto give = [&](CommandRecord& record, CommandCode code, double argument,
                        CommandResult result) {
    static std::uint64_t number = 0;
    record.carry_out({kPlcClient, ++number}, {code, {argument}},
                     [&](const Command&) { return result; });
  };
  auto record = open();
  EXPECT_EQ(record->selection(), Selection());
  give(*record, CommandCode::SelectRecipe, 7, CommandResult::Done);
  give(*record, CommandCode::SelectRecipe, 8, CommandResult::ArgumentOutOfRange);
  give(*record, CommandCode::Stop, 0, CommandResult::Done);
  EXPECT_EQ(record->selection(), (Selection{7, true}));
  give(*record, CommandCode::Start, 0, CommandResult::Done);
  record.reset();
  record = open();
  EXPECT_EQ(record->selection(), (Selection{7, false}));
  record.reset();
  const pid_t other = ::fork();
  ASSERT_GE(other, 0);
  if (other == 0) {
    const bool has_none = CommandRecord(folder_.path()).selection() == Selection();
    ::_exit(has_none ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(other, &status, 0), other);
  EXPECT_EQ(status, 0) << "another process must not continue";
}

TEST_F(CommandRecordTest, ARefusedRecipeGivesWayToTheMeasuredOneUnlessItIsNoLongerSelected) {
  const auto select = [](CommandRecord& record, std::uint64_t number, double recipe) {
    record.carry_out({kPlcClient, number}, {CommandCode::SelectRecipe, {recipe}},
                     [](const Command&) { return CommandResult::Done; });
  };
  auto record = open();
  record->replace_recipe(3, 2);
  EXPECT_EQ(record->selection(), Selection()) << "no command selected one";
  select(*record, 1, 2);
  select(*record, 2, 3);
  record->replace_recipe(3, 2);
  EXPECT_EQ(record->selection(), (Selection{2, false}));
  record.reset();
  record = open();
  EXPECT_EQ(record->selection(), (Selection{2, false})) << "for the next run, too";
  select(*record, 3, 4);
  record->replace_recipe(3, 2);
  EXPECT_EQ(record->selection(), (Selection{4, false})) << "selected after the refusal";
}

TEST_F(CommandRecordTest, WithoutAFolderTheFirstOfEachClientIsNotCarriedOut) {
  CommandRecord record("/proc/orbwatch");
  EXPECT_FALSE(record.is_kept());
  EXPECT_EQ(carry_out(record, {kPlcClient, 7}), CommandResult::NotCarriedOut);
  EXPECT_EQ(carry_out(record, {1, 20}), CommandResult::NotCarriedOut);
  EXPECT_THAT(carried_out_, IsEmpty());
  EXPECT_EQ(carry_out(record, {kPlcClient, 8}), CommandResult::Done);
  EXPECT_EQ(carry_out(record, {1, 21}), CommandResult::Done);
  EXPECT_THAT(carried_out_, ElementsAre(8, 21));
  EXPECT_FALSE(record.is_kept());
}

TEST_F(CommandRecordTest, AFolderThatBecomesUsableHoldsTheNewestCommands) {
  const auto folder = folder_ / "state", away = folder_ / "away";
  carry_out(*std::make_unique<CommandRecord>(folder), {kPlcClient, 7});
  std::filesystem::rename(folder, away);
  tests::set_bytes(folder, "not a folder");
  auto record = std::make_unique<CommandRecord>(folder);
  EXPECT_EQ(carry_out(*record, {1, 20}), CommandResult::NotCarriedOut);
  EXPECT_EQ(carry_out(*record, {kPlcClient, 8}), CommandResult::NotCarriedOut);
  EXPECT_EQ(carry_out(*record, {kPlcClient, 9}), CommandResult::Done);
  EXPECT_FALSE(record->is_kept());

  std::filesystem::remove(folder);
  std::filesystem::rename(away, folder);
  EXPECT_EQ(carry_out(*record, {kPlcClient, 10}), CommandResult::Done);
  EXPECT_TRUE(record->is_kept());
  EXPECT_THAT(carried_out_, ElementsAre(7, 9, 10));
  record.reset();
  EXPECT_THAT(CommandRecord(folder).entries(),
              ElementsAre(Entry{{1, 20}, kStopCode, CommandResult::NotCarriedOut},
                          Entry{{kPlcClient, 10}, kStopCode, CommandResult::Done}));
}

TEST_F(CommandRecordTest, TheSecondOfTwoDaemonsKeepsNone) {
  const auto first = open();
  const auto second = open();
  EXPECT_TRUE(first->is_kept());
  EXPECT_FALSE(second->is_kept());
  EXPECT_EQ(carry_out(*second, {kPlcClient, 7}), CommandResult::NotCarriedOut);
  EXPECT_EQ(carry_out(*first, {kPlcClient, 7}), CommandResult::Done);
}

TEST_F(CommandRecordTest, ADamagedOneIsAsIfUnknownUntilThePlcWasSeen) {
  carry_out(*open(), {kPlcClient, 7});
  const auto file = folder_ / "commands";
  tests::set_bytes(file, std::string(SlotFile::kFileSize, 'x'));
  EXPECT_EQ(carry_out(*open(), {1, 20}), CommandResult::NotCarriedOut);
  // A damaged record counts as unknown after another restart, too: the intact new file does not
  // prove that the PLC was seen.
  const auto record = open();
  EXPECT_TRUE(record->is_kept());
  EXPECT_EQ(carry_out(*record, {kPlcClient, 7}), CommandResult::NotCarriedOut);
  EXPECT_EQ(carry_out(*record, {kPlcClient, 8}), CommandResult::Done);
  EXPECT_THAT(carried_out_, ElementsAre(7, 8));
}

TEST_F(CommandRecordTest, WhatCannotBeNotedIsNotCarriedOut) {
  auto record = open();
  carry_out(*record, {kPlcClient, 7});
  {
    const FullDisk full;
    EXPECT_EQ(carry_out(*record, {kPlcClient, 8}), CommandResult::NotCarriedOut);
    EXPECT_FALSE(record->is_kept());
  }
  EXPECT_EQ(carry_out(*record, {kPlcClient, 9}), CommandResult::Done);
  EXPECT_TRUE(record->is_kept());
  EXPECT_THAT(carried_out_, ElementsAre(7, 9));
}

TEST_F(CommandRecordTest, AResultThatCannotBeNotedIsToldOnceAndInterruptedAfterARestart) {
  auto record = open();
  {
    std::optional<FullDisk> full;
    const auto fill = [&](const Command&) {
      full.emplace();
      return CommandResult::Done;
    };
    EXPECT_EQ(record->carry_out({kPlcClient, 7}, kStop, fill), CommandResult::Done);
    EXPECT_FALSE(record->is_kept());
  }
  record.reset();
  EXPECT_THAT(open()->entries(),
              ElementsAre(Entry{{kPlcClient, 7}, kStopCode, CommandResult::Interrupted}));
}

TEST_F(CommandRecordTest, EachAnsweredCommandWaitsForTheAudit) {
  const auto record = open();
  const Command select{CommandCode::SelectRecipe, {7}, Giver("over Modbus")};
  record->carry_out({kPlcClient, 7}, select, [](const Command&) { return CommandResult::Busy; });
  carry_out(*record, {5, 1});
  const auto first = record->take_unaudited();
  ASSERT_TRUE(first);
  EXPECT_GT(first->time.time_since_epoch().count(), 0);
  EXPECT_EQ(first->id, (CommandId{kPlcClient, 7}));
  EXPECT_EQ(first->command.code, CommandCode::SelectRecipe);
  EXPECT_EQ(first->command.arguments[0], 7);
  EXPECT_EQ(first->command.giver.name(), "over Modbus");
  EXPECT_EQ(first->result, CommandResult::Busy);
  const auto second = record->take_unaudited();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->id, (CommandId{5, 1}));
  EXPECT_EQ(second->result, CommandResult::Done);
  EXPECT_FALSE(record->take_unaudited());
}

TEST_F(CommandRecordTest, ACommandThatCannotBeRecordedWaitsForTheAuditToo) {
  CommandRecord record("/proc/orbwatch");
  carry_out(record, {kPlcClient, 7});
  const auto refused = record.take_unaudited();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->result, CommandResult::NotCarriedOut);
}

TEST_F(CommandRecordTest, AnAuditedCommandDoesNotWaitForTheAudit) {
  const auto record = open();
  const auto done = [](const Command&) { return CommandResult::Done; };
  EXPECT_EQ(record->carry_out_audited({5, 1}, kStop, done), CommandResult::Done);
  EXPECT_THAT(record->entries(), ElementsAre(Entry{{5, 1}, kStopCode, CommandResult::Done}));
  EXPECT_FALSE(record->take_unaudited());
}

TEST_F(CommandRecordTest, WithoutAnAuditTheFirstCommandsWaitAndTheOthersAreCounted) {
  CommandRecord record;
  constexpr std::uint64_t kLost = 5;
  for (std::uint64_t number = 1; number <= CommandRecord::kMostUnaudited + kLost; ++number) {
    EXPECT_EQ(carry_out(record, {kPlcClient, number}), CommandResult::Done);
  }
  EXPECT_EQ(record.lost_unaudited(), kLost);
  std::uint64_t number = 0;
  while (const auto waiting = record.take_unaudited()) EXPECT_EQ(waiting->id.number, ++number);
  EXPECT_EQ(number, CommandRecord::kMostUnaudited);
}

TEST_F(CommandRecordTest, ForgetsTheClientThatIsSilentLongestButNeverThePlc) {
  auto record = open();
  carry_out(*record, {kPlcClient, 7});
  for (std::uint64_t client = 1; client <= CommandRecord::kMaxClients; ++client) {
    carry_out(*record, {client, 1});
  }
  record.reset();
  const auto entries = open()->entries();
  ASSERT_EQ(entries.size(), CommandRecord::kMaxClients);
  EXPECT_EQ(entries[0].id, (CommandId{kPlcClient, 7}));
  EXPECT_EQ(entries[1].id, (CommandId{2, 1}));
}

TEST_F(CommandRecordTest, ServesSeveralPortsAtOnce) {
  auto record = open();
  std::vector<std::jthread> ports;
  for (std::uint64_t client = 0; client < 4; ++client) {
    ports.emplace_back([&record, client] {
      for (std::uint64_t number = 1; number <= 50; ++number) {
        const auto done = [](const Command&) { return CommandResult::Done; };
        EXPECT_EQ(record->carry_out({client, number}, kStop, done), CommandResult::Done);
      }
    });
  }
  ports.clear();
  record.reset();
  const auto entries = open()->entries();
  EXPECT_EQ(entries.size(), 4U);
  for (const Entry& entry : entries) {
    EXPECT_EQ(entry.id.number, 50U);
    EXPECT_EQ(entry.result, CommandResult::Done);
  }
}

}  // namespace
}  // namespace orbwatch::app
