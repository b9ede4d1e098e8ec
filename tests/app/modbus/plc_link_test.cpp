#include "app/modbus/plc_link.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace orbwatch::app::modbus {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kCommand = 11;  // by the manual
constexpr int kHeartbeat = 10;
constexpr auto kTimeout = milliseconds(500);
constexpr auto kStart = hal::TimePoint{} + std::chrono::hours(5);
constexpr std::uint16_t kSetProcessActive = 11;

/// A PLC on a clock that stands until the test moves it.
class PlcLinkTest : public testing::Test {
 protected:
  void write(int address, std::vector<std::uint16_t> values) {
    const int count = static_cast<int>(values.size());
    const Write write{{Table::Holding, address, count}, std::move(values)};
    ASSERT_EQ(check(write, map_), std::nullopt);
    link_.write(write, map_, now_);
  }
  void beat() { write(kHeartbeat, {++heartbeat_}); }
  void say_active(std::uint16_t active) {
    write(0, {0, active});
    write(kCommand, {kSetProcessActive, ++sequence_});
  }
  void advance(milliseconds time) {
    now_ += time;
    link_.watch(now_);
  }
  PlcState state() const { return link_.state(now_); }

  const RegisterMap map_;
  CommandResult answer_ = CommandResult::Done;
  std::vector<int> said_;  ///< arguments of set_process_active
  hal::TimePoint now_ = kStart;
  PlcLink link_{[this](const Command& command) {
                  EXPECT_EQ(command.code, CommandCode::SetProcessActive);
                  said_.push_back(static_cast<int>(command.arguments[0]));
                  return answer_;
                },
                kTimeout, kStart};
  std::uint16_t heartbeat_ = 0;
  std::uint16_t sequence_ = 0;
};

TEST_F(PlcLinkTest, LivesWhileItsHeartbeatChangesInTime) {
  EXPECT_FALSE(state().is_alive);  // not a word yet
  EXPECT_FALSE(state().is_silent);
  EXPECT_EQ(state().age, milliseconds::max());
  beat();
  EXPECT_TRUE(state().is_alive);
  advance(kTimeout);
  EXPECT_TRUE(state().is_alive);
  EXPECT_EQ(state().age, kTimeout);
  write(kHeartbeat, {heartbeat_});  // the same value is no sign of life
  advance(milliseconds(1));
  EXPECT_FALSE(state().is_alive);
  EXPECT_TRUE(state().is_silent);
  beat();
  EXPECT_TRUE(state().is_alive);
  EXPECT_FALSE(state().is_silent);
  EXPECT_EQ(state().age, milliseconds(0));
}

TEST_F(PlcLinkTest, OneThatNeverCameIsSilent) {
  advance(kTimeout);
  EXPECT_FALSE(state().is_silent);
  advance(milliseconds(1));
  EXPECT_TRUE(state().is_silent);
  EXPECT_EQ(state().age, milliseconds::max());
  EXPECT_THAT(said_, IsEmpty());
}

TEST_F(PlcLinkTest, WhatItSaidFallsBackOnceWhenItIsSilent) {
  beat();
  say_active(1);
  EXPECT_THAT(said_, ElementsAre(1));
  advance(kTimeout);
  EXPECT_THAT(said_, ElementsAre(1));
  advance(milliseconds(1));
  EXPECT_THAT(said_, ElementsAre(1, 0));
  for (int i = 0; i < 10; ++i) advance(kTimeout);
  EXPECT_THAT(said_, ElementsAre(1, 0));
  // Living again does not make the process active: it must say so.
  beat();
  advance(milliseconds(1));
  EXPECT_THAT(said_, ElementsAre(1, 0));
  say_active(1);
  advance(kTimeout + milliseconds(1));
  EXPECT_THAT(said_, ElementsAre(1, 0, 1, 0));
}

TEST_F(PlcLinkTest, NothingFallsBackThatWasNotSaid) {
  beat();
  say_active(1);
  say_active(0);
  advance(2 * kTimeout);
  EXPECT_THAT(said_, ElementsAre(1, 0));
}

TEST_F(PlcLinkTest, OneThatDoesNotBeatCannotKeepTheProcessActive) {
  advance(2 * kTimeout);
  say_active(1);
  advance(milliseconds(0));
  EXPECT_THAT(said_, ElementsAre(1, 0));
}

TEST_F(PlcLinkTest, FallsBackLaterWhenItCannotNow) {
  beat();
  say_active(1);
  answer_ = CommandResult::Busy;
  advance(2 * kTimeout);
  answer_ = CommandResult::Done;
  advance(kTimeout);
  advance(kTimeout);
  EXPECT_THAT(said_, ElementsAre(1, 0, 0));
}

TEST_F(PlcLinkTest, ARefusedStatementIsNotTakenBack) {
  beat();
  answer_ = CommandResult::NotPossible;
  say_active(1);
  advance(2 * kTimeout);
  EXPECT_THAT(said_, ElementsAre(1));
}

TEST_F(PlcLinkTest, AsksToBeCalledWhenTheTimeIsOver) {
  beat();
  say_active(1);
  now_ += milliseconds(200);
  const auto next = link_.watch(now_);
  EXPECT_GT(next, kStart + kTimeout);
  EXPECT_LE(next, kStart + kTimeout + milliseconds(1));
  now_ = next;
  link_.watch(now_);
  EXPECT_THAT(said_, ElementsAre(1, 0));
}

TEST_F(PlcLinkTest, IsNotWatchedWithoutATimeout) {
  const CommandHandler unexpected = [](const Command&) {
    ADD_FAILURE() << "nobody watches";
    return CommandResult::Done;
  };
  PlcLink link(unexpected, milliseconds(0), kStart);
  link.write({{Table::Holding, kHeartbeat, 1}, {1}}, map_, kStart);
  EXPECT_EQ(link.watch(kStart + std::chrono::hours(1)), hal::TimePoint::max());
  const PlcState state = link.state(kStart + std::chrono::seconds(1));
  EXPECT_FALSE(state.is_alive);
  EXPECT_FALSE(state.is_silent);
  EXPECT_EQ(state.age, std::chrono::seconds(1));
}

TEST_F(PlcLinkTest, TellsOnceWhichResultARequestTakes) {
  const Write taking{{Table::Holding, 8, 2}, {1, 2}};
  EXPECT_EQ(link_.write(taking, map_, now_), 0x1'0002U);
  EXPECT_EQ(link_.write({{Table::Holding, kHeartbeat, 1}, {9}}, map_, now_), 0U);
}

}  // namespace
}  // namespace orbwatch::app::modbus
