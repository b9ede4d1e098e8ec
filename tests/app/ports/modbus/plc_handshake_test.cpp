// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/plc_handshake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/app/ports/modbus/clients.h"

namespace orbwatch::app::modbus {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;
using tests::address_of;

constexpr auto kTimeout = milliseconds(500);
constexpr auto kStart = hal::TimePoint{} + std::chrono::hours(5);
constexpr std::uint16_t kSetProcessActive = 11;

/// A PLC with a clock that only the test advances.
class PlcHandshakeTest : public testing::Test {
 protected:
  void write(int address, std::vector<std::uint16_t> values) {
    const int count = static_cast<int>(values.size());
    const Write write{{Table::Holding, address, count}, std::move(values)};
    ASSERT_EQ(check(write, map_), std::nullopt);
    plc_.write(write, map_, now_);
    plc_.carry_out();
  }
  void beat() { write(heartbeat_register_, {++heartbeat_}); }
  void say_active(std::uint16_t active) {
    write(address_of("argument_0"), {0, active});
    write(command_, {kSetProcessActive, ++sequence_});
  }
  void advance(milliseconds time) {
    now_ += time;
    plc_.supervise(now_);
  }
  PlcStatus status() const { return plc_.status(now_); }

  const RegisterMap map_;
  const int command_ = address_of("command");
  const int heartbeat_register_ = address_of("plc_heartbeat");
  CommandResult answer_ = CommandResult::Done;
  std::vector<int> said_;  ///< arguments of set_process_active
  hal::TimePoint now_ = kStart;
  CommandRecord record_;
  PlcHandshake plc_{record_,
                    [this](const Command& command) {
                      EXPECT_EQ(command.code, CommandCode::SetProcessActive);
                      said_.push_back(static_cast<int>(command.arguments[0]));
                      return answer_;
                    },
                    kTimeout, kStart};
  std::uint16_t heartbeat_ = 0;
  std::uint16_t sequence_ = 0;
};

TEST_F(PlcHandshakeTest, LivesWhileItsHeartbeatChangesInTime) {
  EXPECT_FALSE(status().alive);  // no heartbeat yet
  EXPECT_FALSE(status().silent);
  EXPECT_EQ(status().heartbeat, hal::TimePoint{});
  beat();
  EXPECT_TRUE(status().alive);
  advance(kTimeout);
  EXPECT_TRUE(status().alive);
  EXPECT_EQ(now_ - status().heartbeat, kTimeout);
  write(heartbeat_register_, {heartbeat_});  // the same value does not count as a heartbeat
  advance(milliseconds(1));
  EXPECT_FALSE(status().alive);
  EXPECT_TRUE(status().silent);
  beat();
  EXPECT_TRUE(status().alive);
  EXPECT_FALSE(status().silent);
  EXPECT_EQ(status().heartbeat, now_);
}

TEST_F(PlcHandshakeTest, OneThatNeverCameIsSilent) {
  advance(kTimeout);
  EXPECT_FALSE(status().silent);
  advance(milliseconds(1));
  EXPECT_TRUE(status().silent);
  EXPECT_EQ(status().heartbeat, hal::TimePoint{});
  EXPECT_THAT(said_, IsEmpty());
}

TEST_F(PlcHandshakeTest, WhatItSaidFallsBackOnceWhenItIsSilent) {
  beat();
  say_active(1);
  EXPECT_THAT(said_, ElementsAre(1));
  advance(kTimeout);
  EXPECT_THAT(said_, ElementsAre(1));
  advance(milliseconds(1));
  EXPECT_THAT(said_, ElementsAre(1, 0));
  for (int i = 0; i < 10; ++i) advance(kTimeout);
  EXPECT_THAT(said_, ElementsAre(1, 0));
  // A new heartbeat does not make the process active: a command must.
  beat();
  advance(milliseconds(1));
  EXPECT_THAT(said_, ElementsAre(1, 0));
  say_active(1);
  advance(kTimeout + milliseconds(1));
  EXPECT_THAT(said_, ElementsAre(1, 0, 1, 0));
}

TEST_F(PlcHandshakeTest, NothingFallsBackThatWasNotSaid) {
  beat();
  say_active(1);
  say_active(0);
  advance(2 * kTimeout);
  EXPECT_THAT(said_, ElementsAre(1, 0));
}

TEST_F(PlcHandshakeTest, OneThatDoesNotBeatCannotKeepTheProcessActive) {
  advance(2 * kTimeout);
  say_active(1);
  advance(milliseconds(0));
  EXPECT_THAT(said_, ElementsAre(1, 0));
}

TEST_F(PlcHandshakeTest, FallsBackLaterWhenItCannotNow) {
  beat();
  say_active(1);
  answer_ = CommandResult::Busy;
  advance(2 * kTimeout);
  answer_ = CommandResult::Done;
  advance(kTimeout);
  advance(kTimeout);
  EXPECT_THAT(said_, ElementsAre(1, 0, 0));
}

TEST_F(PlcHandshakeTest, ARefusedStatementIsNotTakenBack) {
  beat();
  answer_ = CommandResult::NotPossible;
  say_active(1);
  advance(2 * kTimeout);
  EXPECT_THAT(said_, ElementsAre(1));
}

TEST_F(PlcHandshakeTest, ItsCommandsWaitForTheAuditAndTheFallBackIsNotItsCommand) {
  beat();
  answer_ = CommandResult::NotPossible;
  say_active(1);
  answer_ = CommandResult::Done;
  say_active(1);
  advance(2 * kTimeout);
  EXPECT_THAT(said_, ElementsAre(1, 1, 0));
  for (const CommandResult result : {CommandResult::NotPossible, CommandResult::Done}) {
    const auto waiting = record_.take_unaudited();
    ASSERT_TRUE(waiting);
    EXPECT_EQ(waiting->id.client, kPlcClient);
    EXPECT_EQ(waiting->command.code, CommandCode::SetProcessActive);
    EXPECT_EQ(waiting->command.arguments[0], 1);
    EXPECT_EQ(waiting->command.giver.name(), "over Modbus");
    EXPECT_EQ(waiting->result, result);
  }
  EXPECT_FALSE(record_.take_unaudited());
}

TEST_F(PlcHandshakeTest, AsksToBeCalledWhenTheTimeIsOver) {
  beat();
  say_active(1);
  now_ += milliseconds(200);
  const auto next = plc_.supervise(now_);
  EXPECT_GT(next, kStart + kTimeout);
  EXPECT_LE(next, kStart + kTimeout + milliseconds(1));
  now_ = next;
  plc_.supervise(now_);
  EXPECT_THAT(said_, ElementsAre(1, 0));
}

TEST_F(PlcHandshakeTest, IsNotSupervisedWithoutATimeout) {
  const CommandHandler unexpected = [](const Command&) {
    ADD_FAILURE() << "nobody supervises";
    return CommandResult::Done;
  };
  CommandRecord record;
  PlcHandshake plc(record, unexpected, milliseconds(0), kStart);
  plc.write({{Table::Holding, heartbeat_register_, 1}, {1}}, map_, kStart);
  EXPECT_EQ(plc.supervise(kStart + std::chrono::hours(1)), hal::TimePoint::max());
  const PlcStatus status = plc.status(kStart + std::chrono::seconds(1));
  EXPECT_FALSE(status.alive);
  EXPECT_FALSE(status.silent);
  EXPECT_EQ(status.heartbeat, kStart);
}

TEST_F(PlcHandshakeTest, ReturnsOnceWhichResultARequestAcknowledges) {
  const Write write{{Table::Holding, address_of("result_acknowledged"), 2}, {1, 2}};
  EXPECT_EQ(plc_.write(write, map_, now_), 0x1'0002U);
  EXPECT_EQ(plc_.write({{Table::Holding, heartbeat_register_, 1}, {9}}, map_, now_), 0U);
}

}  // namespace
}  // namespace orbwatch::app::modbus
