#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>

#include "clients.h"

namespace orbwatch::app {
namespace {

using testing::ElementsAre;
using tests::loopback;
using tests::Plc;
using tests::RawClient;
using tests::Words;

// By the manual.
constexpr int kArgument = 0;
constexpr int kCommand = 2;
constexpr int kSequence = 3;
constexpr int kAcknowledged = 4;

/// A server whose commands are written down.
class ModbusCommand : public testing::Test {
 protected:
  void SetUp() override {
    const auto started = sink_.start();
    ASSERT_TRUE(started) << started.error().message;
  }

  CommandResult carry_out(const Command& command) {
    const std::lock_guard lock(mutex_);
    arguments_.push_back(command.argument);
    return command.argument < 8 ? CommandResult::Done : CommandResult::ArgumentOutOfRange;
  }

  std::vector<int> arguments() {
    const std::lock_guard lock(mutex_);
    return arguments_;
  }

  std::mutex mutex_;
  std::vector<int> arguments_;
  ModbusSink sink_{loopback(), [this](const Command& command) { return carry_out(command); }};
};

TEST_F(ModbusCommand, IsCarriedOutByOneWriteAndAcknowledged) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.read_holding(0, 7), 0);
  EXPECT_THAT(plc.words, ElementsAre(0, 0, 0, 0, 0, 0, 0));
  ASSERT_EQ(plc.write(kArgument, {0, 5, 1, 100}), 0);
  EXPECT_THAT(arguments(), ElementsAre(5));
  ASSERT_EQ(plc.read_holding(0, 7), 0);
  EXPECT_THAT(plc.words, ElementsAre(0, 5, 1, 100, 100, 0, 1));
}

TEST_F(ModbusCommand, IsCarriedOutWhenTheSequenceComesLast) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.write(kArgument, {0, 6}), 0);
  ASSERT_EQ(plc.write(kCommand, 1), 0);
  EXPECT_TRUE(arguments().empty());
  ASSERT_EQ(plc.write(kSequence, 1), 0);
  EXPECT_THAT(arguments(), ElementsAre(6));
}

TEST_F(ModbusCommand, IsCarriedOutOncePerSequence) {
  Plc plc(sink_.port());
  for (int repetition = 0; repetition < 3; ++repetition) {
    ASSERT_EQ(plc.write(kArgument, {0, 5, 1, 7}), 0);
    ASSERT_EQ(plc.write(kSequence, 7), 0);
  }
  ASSERT_EQ(plc.write(kArgument, {0, 4}), 0);  // without a new sequence nothing happens
  Plc(sink_.port()).write(kSequence, 7);
  EXPECT_THAT(arguments(), ElementsAre(5));
  ASSERT_EQ(plc.write(kSequence, 8), 0);
  EXPECT_THAT(arguments(), ElementsAre(5, 4));
  ASSERT_EQ(plc.write(kSequence, 0), 0);  // wraps: 0 is a sequence like any other
  EXPECT_THAT(arguments(), ElementsAre(5, 4, 4));
}

TEST_F(ModbusCommand, NegativeArgumentsArriveWhole) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.write(kArgument, {0xffff, 0xfffe, 1, 1}), 0);
  EXPECT_THAT(arguments(), ElementsAre(-2));
  ASSERT_EQ(plc.read_holding(0, 2), 0);
  EXPECT_EQ(plc.i32(0), -2);
}

TEST_F(ModbusCommand, TellsTheHandlersResult) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.write(kArgument, {0, 9, 1, 1}), 0);
  ASSERT_EQ(plc.read_holding(kAcknowledged, 3), 0);
  EXPECT_THAT(plc.words, ElementsAre(1, 2, 1));
}

TEST_F(ModbusCommand, CodeZeroIsAnsweredButNotCarriedOut) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.write(kSequence, 5), 0);
  ASSERT_EQ(plc.read_holding(kAcknowledged, 3), 0);
  EXPECT_THAT(plc.words, ElementsAre(5, 1, 0));
  EXPECT_TRUE(arguments().empty());
}

TEST_F(ModbusCommand, WriteAndReadInOneRequestSeesTheAcknowledgement) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.write_and_read(kArgument, {0, 3, 1, 77}, kAcknowledged, 3), 0);
  EXPECT_THAT(plc.words, ElementsAre(77, 0, 1));
  EXPECT_THAT(arguments(), ElementsAre(3));
}

TEST_F(ModbusCommand, MaskWriteChangesBitsOfTheSequence) {
  Plc plc(sink_.port());
  ASSERT_EQ(plc.write(kArgument, {0, 3, 1, 0x00f0}), 0);
  ASSERT_EQ(plc.mask_write(kSequence, 0xff0f, 0x0a30), 0);
  ASSERT_EQ(plc.read_holding(kSequence, 2), 0);
  // (0x00f0 and 0xff0f) or (0x0a30 and 0x00f0): bits outside the mask stay.
  EXPECT_THAT(plc.words, ElementsAre(0x0030, 0x0030));
  EXPECT_THAT(arguments(), ElementsAre(3, 3));
}

TEST_F(ModbusCommand, ARefusedWriteChangesNothing) {
  Plc plc(sink_.port());
  EXPECT_EQ(plc.write(kArgument, {0, 5, 99, 1}), 3);  // there is no command 99
  EXPECT_EQ(plc.write(kCommand, 0xffff), 3);
  EXPECT_EQ(plc.mask_write(kCommand, 0, 0x8000), 3);
  EXPECT_EQ(plc.write(kArgument, 5), 2);              // half of a double word
  EXPECT_EQ(plc.write(kArgument + 1, {5, 1, 1}), 2);  // the other half
  EXPECT_EQ(plc.mask_write(kArgument, 0, 1), 2);
  EXPECT_EQ(plc.write(kArgument, {0, 5, 1, 1, 1}), 2);  // runs into the acknowledgement
  EXPECT_EQ(plc.write(kAcknowledged, 1), 2);
  EXPECT_EQ(plc.write_and_read(kArgument, {0, 5, 1, 1}, 999, 1), 2);  // nothing to read there
  EXPECT_EQ(plc.write_and_read(kArgument, {0, 5, 99, 1}, 0, 1), 3);
  EXPECT_TRUE(arguments().empty());
  ASSERT_EQ(plc.read_holding(0, 7), 0);
  EXPECT_THAT(plc.words, ElementsAre(0, 0, 0, 0, 0, 0, 0));
}

TEST_F(ModbusCommand, NothingElseIsWritable) {
  Plc plc(sink_.port());
  const modbus::RegisterMap map;
  for (int address = 4; address < 2000; ++address) {
    ASSERT_EQ(plc.write(address, 0), 2) << address;
  }
  EXPECT_EQ(plc.write(65535, 0), 2);
  for (int address = 0; address < 1020; ++address) ASSERT_EQ(plc.write_coil(address), 2);
  EXPECT_EQ(plc.write_coils(1000, 16), 2);
  EXPECT_TRUE(arguments().empty());
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
  const tests::Bytes write{16, 0, 0, 0, 4, 8, 0, 0, 0, 1, 0, 1, 0, 1};
  RawClient stranger(sink.port());
  ASSERT_TRUE(stranger.send(tests::frame(write)));
  EXPECT_EQ(stranger.receive_pdu(), (tests::Bytes{0x90, 1}));
  ASSERT_TRUE(stranger.send(tests::frame({3, 0, 4, 0, 1})));
  EXPECT_EQ(stranger.receive_pdu(), (tests::Bytes{3, 2, 0, 0}));

  RawClient writer(sink.port(), "127.0.0.2");
  ASSERT_TRUE(writer.send(tests::frame(write)));
  EXPECT_EQ(writer.receive_pdu(), (tests::Bytes{16, 0, 0, 0, 4}));
  sink.stop();
  EXPECT_EQ(carried_out, 1);
}

}  // namespace
}  // namespace orbwatch::app
