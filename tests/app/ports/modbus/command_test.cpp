// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>

#include "app/log_writer.h"
#include "tests/app/ports/modbus/clients.h"
#include "tests/support/network_namespace.h"

namespace orbwatch::app {
namespace {

using testing::Each;
using testing::ElementsAre;
using tests::address_of;
using tests::bit_of;
using tests::kAcknowledged;
using tests::kArguments;
using tests::kSequence;
using tests::loopback;
using tests::Plc;
using tests::RawClient;
using tests::select_view;
using tests::Words;

const int kHeartbeat = address_of("plc_heartbeat");
const int kCommand = address_of("command");
const int kHoldingCount = address_of("last_command") + 1;

/// A server that records its commands.
class ModbusCommand : public testing::Test {
 protected:
  void SetUp() override {
    const auto started = sink_.start();
    ASSERT_TRUE(started) << started.error().message;
  }

  CommandResult carry_out(const Command& command) {
    const std::lock_guard lock(mutex_);
    arguments_.push_back(static_cast<std::int32_t>(command.arguments[0]));
    last_command_ = command;
    return command.arguments[0] < 8 ? CommandResult::Done : CommandResult::ArgumentOutOfRange;
  }

  std::vector<int> arguments() {
    const std::lock_guard lock(mutex_);
    return arguments_;
  }

  Command last_command() {
    const std::lock_guard lock(mutex_);
    return last_command_;
  }

  std::mutex mutex_;
  std::vector<int> arguments_;
  Command last_command_;
  ModbusSink sink_{loopback(), [this](const Command& command) { return carry_out(command); }};
};

TEST_F(ModbusCommand, IsCarriedOutByOneWriteAndAcknowledged) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.read_holding(0, kHoldingCount), 0);
  EXPECT_THAT(plc.words, Each(0));
  ASSERT_EQ(plc.command(kArguments, select_view(5, 100)), 0);
  EXPECT_THAT(arguments(), ElementsAre(5));
  ASSERT_EQ(plc.read_holding(0, kHoldingCount), 0);
  EXPECT_THAT(plc.words, ElementsAre(0, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 100, 100, 0, 1));
}

TEST_F(ModbusCommand, IsCarriedOutWhenTheSequenceComesLast) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.write(kArguments, {0, 6}), 0);
  ASSERT_EQ(plc.write(kCommand, 1), 0);
  EXPECT_TRUE(arguments().empty());
  ASSERT_EQ(plc.command(kSequence, {1}), 0);
  EXPECT_THAT(arguments(), ElementsAre(6));
}

TEST_F(ModbusCommand, IsCarriedOutOncePerSequence) {
  Plc plc(sink_.port());
  for (int repetition = 0; repetition < 3; ++repetition) {
    ASSERT_EQ(plc.command(kArguments, select_view(5, 7)), 0);
    ASSERT_EQ(plc.command(kSequence, {7}), 0);
  }
  ASSERT_EQ(plc.write(kArguments, {0, 4}), 0);  // has no effect without a new sequence
  Plc(sink_.port()).command(kSequence, {7});
  EXPECT_THAT(arguments(), ElementsAre(5));
  ASSERT_EQ(plc.command(kSequence, {8}), 0);
  EXPECT_THAT(arguments(), ElementsAre(5, 4));
  ASSERT_EQ(plc.command(kSequence, {0}), 0);  // wraps: 0 is a valid sequence
  EXPECT_THAT(arguments(), ElementsAre(5, 4, 4));
}

TEST_F(ModbusCommand, ArgumentsAreScaledAsTheListOfCommandsSays) {
  Plc plc(sink_.port());
  // point_view: view 3, yaw -115.01 deg, pitch 12.5 deg, h_fov 80 deg.
  const auto yaw = static_cast<std::uint16_t>(-11501);
  ASSERT_EQ(plc.command(kArguments, {0, 3, 0xffff, yaw, 0, 1250, 0, 8000, 0, 0, 0, 6, 1}), 0);
  const Command command = last_command();
  EXPECT_EQ(command.code, CommandCode::PointView);
  EXPECT_EQ(command.giver.name(), "over Modbus");
  EXPECT_EQ(command.arguments[0], 3);
  EXPECT_NEAR(command.arguments[1], -115.01, 1e-9);
  EXPECT_NEAR(command.arguments[2], 12.5, 1e-9);
  EXPECT_NEAR(command.arguments[3], 80, 1e-9);
  ASSERT_EQ(plc.read_holding(2, 2), 0);
  EXPECT_EQ(plc.i32(0), -11501);
  ASSERT_EQ(plc.read_holding(kAcknowledged, 2), 0);
  EXPECT_THAT(plc.words, ElementsAre(1, 0));
}

TEST(CommandRegisters, TheEndsOfEveryArgumentsRangePassAndNoMore) {
  for (const CommandInfo& info : kCommands) {
    modbus::CommandRegisters registers{.arguments{},
                                       .command = static_cast<std::uint16_t>(info.code)};
    const auto set_to = [&](std::size_t i, double value) {
      registers.arguments[i] =
          static_cast<std::int32_t>(std::lround(value / info.arguments[i].scale));
    };
    for (std::size_t i = 0; i < info.argument_count(); ++i) set_to(i, info.arguments[i].minimum);
    EXPECT_EQ(check(modbus::command_in(registers)), CommandResult::Done) << info.name;
    // Starts with the last argument, which then leaves room for one that must be below it.
    for (std::size_t i = info.argument_count(); i-- > 0;) {
      set_to(i, info.arguments[i].maximum);
      EXPECT_EQ(check(modbus::command_in(registers)), CommandResult::Done) << info.name << i;
      ++registers.arguments[i];
      EXPECT_EQ(check(modbus::command_in(registers)), CommandResult::ArgumentOutOfRange)
          << info.name << i;
      set_to(i, info.arguments[i].minimum);
      --registers.arguments[i];
      EXPECT_EQ(check(modbus::command_in(registers)), CommandResult::ArgumentOutOfRange)
          << info.name << i;
      set_to(i, info.arguments[i].maximum);
    }
  }
}

TEST_F(ModbusCommand, TellsTheHandlersResult) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.command(kArguments, select_view(9, 1)), 0);
  ASSERT_EQ(plc.read_holding(kAcknowledged, 3), 0);
  EXPECT_THAT(plc.words, ElementsAre(1, 2, 1));
}

TEST_F(ModbusCommand, CodeZeroIsAnsweredButNotCarriedOut) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.command(kSequence, {5}), 0);
  ASSERT_EQ(plc.read_holding(kAcknowledged, 3), 0);
  EXPECT_THAT(plc.words, ElementsAre(5, 1, 0));
  EXPECT_TRUE(arguments().empty());
}

TEST_F(ModbusCommand, WriteAndReadInOneRequestCanBeRepeatedUntilItSeesTheAcknowledgement) {
  Plc plc(sink_.port());
  EXPECT_TRUE(tests::eventually([&] {
    EXPECT_EQ(plc.write_and_read(kArguments, select_view(3, 77), kAcknowledged, 3), 0);
    return plc.words == Words{77, 0, 1};
  }));
  EXPECT_THAT(arguments(), ElementsAre(3));
}

TEST_F(ModbusCommand, MaskWriteChangesBitsOfTheSequence) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.command(kArguments, select_view(3, 0x00f0)), 0);
  ASSERT_EQ(plc.mask_write(kSequence, 0xff0f, 0x0a30), 0);
  // (0x00f0 and 0xff0f) or (0x0a30 and 0x00f0): bits outside the mask stay.
  EXPECT_TRUE(tests::eventually([&] {
    EXPECT_EQ(plc.read_holding(kSequence, 2), 0);
    return plc.words == Words{0x0030, 0x0030};
  }));
  EXPECT_THAT(arguments(), ElementsAre(3, 3));
}

TEST_F(ModbusCommand, ARefusedWriteChangesNothing) {
  Plc plc(sink_.port());
  Words unknown = select_view(5, 1);
  unknown[static_cast<std::size_t>(kCommand - kArguments)] = 99;
  Words too_long = select_view(5, 1);
  too_long.push_back(1);
  EXPECT_EQ(plc.write(kArguments, unknown), 3);
  EXPECT_EQ(plc.write(kCommand, 0xffff), 3);
  EXPECT_EQ(plc.mask_write(kCommand, 0, 0x8000), 3);
  EXPECT_EQ(plc.write(kArguments, 5), 2);              // half of a double word
  EXPECT_EQ(plc.write(kArguments + 1, {5, 1, 1}), 2);  // the other half
  EXPECT_EQ(plc.write(kHeartbeat - 1, {5, 1}), 2);     // the lower half of result_acknowledged
  EXPECT_EQ(plc.mask_write(kArguments, 0, 1), 2);
  EXPECT_EQ(plc.write(kArguments, too_long), 2);  // overlaps the acknowledgement
  EXPECT_EQ(plc.write(kAcknowledged, 1), 2);
  EXPECT_EQ(plc.write_and_read(kArguments, select_view(5, 1), 4999, 1),
            2);  // not readable
  EXPECT_EQ(plc.write_and_read(kArguments, unknown, 0, 1), 3);
  EXPECT_TRUE(arguments().empty());
  ASSERT_EQ(plc.read_holding(0, kHoldingCount), 0);
  EXPECT_THAT(plc.words, Each(0));
}

TEST_F(ModbusCommand, NothingElseIsWritable) {
  Plc plc(sink_.port());
  const modbus::RegisterMap map;
  for (int address = kAcknowledged; address <= map.size(modbus::Table::Holding); ++address) {
    ASSERT_EQ(plc.write(address, 0), 2) << address;
  }
  EXPECT_EQ(plc.write(65535, 0), 2);
  for (int address = 0; address < map.size(modbus::Table::Coil); ++address) {
    ASSERT_EQ(plc.write_coil(address), 2);
  }
  EXPECT_EQ(plc.write_coils(5000, 16), 2);
  EXPECT_TRUE(arguments().empty());
}

TEST(ModbusPlcHeartbeat, WithoutItTheProcessIsTakenForInactive) {
  ModbusSettings settings = loopback();
  settings.plc_timeout_ms = 50;
  std::mutex mutex;
  std::vector<int> said;
  ModbusSink sink(settings, [&](const Command& command) {
    const std::lock_guard lock(mutex);
    if (command.code == CommandCode::SetProcessActive) {
      said.push_back(static_cast<int>(command.arguments[0]));
    }
    return CommandResult::Done;
  });
  ASSERT_TRUE(sink.start());
  Plc plc(sink.port());
  const auto status_bit = [&](const char* name) {
    EXPECT_EQ(plc.read_discrete(bit_of(name), 1), 0);
    return plc.bits[0] == 1;
  };
  ASSERT_EQ(plc.write(kArguments, {0, 1}), 0);
  std::uint16_t heartbeat = 0;
  // One write sets both, so there is no moment between them.
  const auto beat_and_say_active = [&](std::uint16_t sequence) {
    ASSERT_EQ(plc.write(kHeartbeat, {++heartbeat, 11, sequence}), 0);
  };
  beat_and_say_active(1);
  ASSERT_TRUE(tests::eventually([&] { return !status_bit("plc_alive"); }));
  ASSERT_TRUE(tests::eventually([&] {
    const std::lock_guard lock(mutex);
    return said.size() == 2;
  }));
  ASSERT_EQ(plc.read_input(address_of("fault_bits"), 2), 0);
  EXPECT_EQ(plc.u32(0) & 0b100, 0b100);  // plc_silent
  ASSERT_TRUE(tests::eventually([&] {
    plc.write(kHeartbeat, ++heartbeat);
    return status_bit("plc_alive");
  }));
  sink.stop();
  EXPECT_THAT(said, ElementsAre(1, 0));
}

TEST(ModbusWriters, WithoutAListOtherHostsMayOnlyRead) {
  ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
  const orbwatch::tests::NetworkNamespace appliance, machine;
  const orbwatch::tests::Cable cable(appliance, machine);
  ModbusSettings settings = loopback();
  settings.address = "0.0.0.0";
  int carried_out = 0;
  ModbusSink sink(settings, [&](const Command&) {
    ++carried_out;
    return CommandResult::Done;
  });
  appliance.run([&] { ASSERT_TRUE(sink.start()); });
  const auto write_from = [&](const orbwatch::tests::NetworkNamespace& where) {
    int exception = -1;
    where.run([&] {
      Plc plc(sink.port(), 1, orbwatch::tests::Cable::kLeft);
      EXPECT_EQ(plc.read_input(0, 1), 0);
      exception = plc.write(kCommand, {1, 1});
    });
    return exception;
  };
  EXPECT_EQ(write_from(machine), 1);
  EXPECT_EQ(write_from(appliance), 0);
  sink.stop();
  EXPECT_EQ(carried_out, 1);
}

TEST(ModbusWriters, SaysWhoTheyAre) {
  ModbusSettings settings;
  EXPECT_EQ(commanders(settings), "over Modbus from this host only");
  settings.writers = {"10.0.0.7", "10.1.0.0/24"};
  EXPECT_EQ(commanders(settings), "over Modbus from [\"10.0.0.7\", \"10.1.0.0/24\"]");
  settings.serial.emplace().device = "/dev/ttyUSB0";
  EXPECT_EQ(commanders(settings),
            "over Modbus from [\"10.0.0.7\", \"10.1.0.0/24\"] and on the serial line /dev/ttyUSB0");
  settings.serial->may_write = false;
  EXPECT_EQ(commanders(settings), "over Modbus from [\"10.0.0.7\", \"10.1.0.0/24\"]");
  settings.enabled = false;
  EXPECT_EQ(commanders(settings), "");
}

/// A stalled journal must not delay the PLC.
TEST(ModbusWriters, AreServedWhileNobodyReadsTheLogOfARefusal) {
  std::mutex reading;
  std::unique_lock unread(reading);
  LogWriter log([&reading](const LogRecord&) { const std::lock_guard reads(reading); });
  ModbusSettings settings = loopback();
  settings.writers = {"127.0.0.2"};
  ModbusSink sink(settings, [](const Command&) { return CommandResult::Done; });
  ASSERT_TRUE(sink.start());
  const auto command = static_cast<std::uint8_t>(kCommand);
  const tests::Bytes write{16, 0, command, 0, 2, 4, 0, 1, 0, 1};
  RawClient stranger(sink.port());
  ASSERT_TRUE(stranger.send(tests::frame(write)));
  EXPECT_EQ(tests::receive_pdu(stranger), (tests::Bytes{0x90, 1}));
  RawClient writer(sink.port(), "127.0.0.2");
  ASSERT_TRUE(writer.send(tests::frame(write)));
  EXPECT_EQ(tests::receive_pdu(writer), (tests::Bytes{16, 0, command, 0, 2}));
  unread.unlock();
  sink.stop();
}

TEST(ModbusWriters, OthersMayOnlyRead) {
  ModbusSettings settings = loopback();
  settings.writers = {"192.0.2.7", "127.0.0.2"};
  int carried_out = 0;
  ModbusSink sink(settings, [&](const Command&) {
    ++carried_out;
    return CommandResult::Done;
  });
  ASSERT_TRUE(sink.start());
  const auto command = static_cast<std::uint8_t>(kCommand);
  const auto acknowledged = static_cast<std::uint8_t>(kAcknowledged);
  const tests::Bytes write{16, 0, command, 0, 2, 4, 0, 1, 0, 1};
  testing::internal::CaptureStderr();
  RawClient stranger(sink.port());
  ASSERT_TRUE(stranger.send(tests::frame(write)));
  EXPECT_EQ(tests::receive_pdu(stranger), (tests::Bytes{0x90, 1}));
  ASSERT_TRUE(stranger.send(tests::frame({3, 0, acknowledged, 0, 1})));
  EXPECT_EQ(tests::receive_pdu(stranger), (tests::Bytes{3, 2, 0, 0}));
  RawClient again(sink.port());
  ASSERT_TRUE(again.send(tests::frame(write)));
  EXPECT_EQ(tests::receive_pdu(again), (tests::Bytes{0x90, 1}));
  // The log line appears once, in the syntax of the site file.
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "orbwatch: modbus: write refused to 127.0.0.1; to permit it, set in [modbus] of the "
            "site file: writers = [\"192.0.2.7\", \"127.0.0.2\", \"127.0.0.1\"]\n");

  RawClient writer(sink.port(), "127.0.0.2");
  ASSERT_TRUE(writer.send(tests::frame(write)));
  EXPECT_EQ(tests::receive_pdu(writer), (tests::Bytes{16, 0, command, 0, 2}));
  sink.stop();
  EXPECT_EQ(carried_out, 1);
}

}  // namespace
}  // namespace orbwatch::app
