#include "app/modbus/modbus_sink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <thread>

#include "clients.h"

namespace orbwatch::app {
namespace {

using testing::HasSubstr;
using tests::accept_all;
using tests::eventually;
using tests::loopback;
using tests::Plc;

std::string start_error(const ModbusSettings& settings) {
  ModbusSink sink(settings, accept_all);
  const auto started = sink.start();
  return started ? "" : started.error().message;
}

TEST(ModbusSink, ServesSignalsScaledSignedOrNotValid) {
  ModbusSink sink(loopback(), accept_all);
  ASSERT_TRUE(sink.start());
  sink.accept(tests::example_status());
  Plc plc(sink.port());
  ASSERT_EQ(plc.read_input(1000, 125), 0);
  EXPECT_EQ(plc.u32(0), 0x0013'0016U);  // result
  EXPECT_EQ(plc.u32(2), 0x8001'0203U);  // frame set
  EXPECT_EQ(plc.u32(8), 0x0012'0015U);  // trigger
  EXPECT_EQ(plc.u32(10), 0x89ab'cdefU);
  EXPECT_EQ(plc.words[12], 7);  // recipe
  EXPECT_EQ(plc.words[13], 1);  // quality
  EXPECT_EQ(plc.words[14], 1);  // process active
  const auto signal = [&](double signals::Signals::*member) {
    std::size_t n = 0;
    while (signals::kSignals[n].member != member) ++n;
    const bool is_valid = (plc.words[16 + n / 16] >> n % 16 & 1) != 0;
    EXPECT_EQ(is_valid, plc.u32(20 + 2 * n) != 0x80000000U) << signals::kSignals[n].name;
    return plc.i32(20 + 2 * n);
  };
  constexpr auto kNotValid = std::numeric_limits<std::int32_t>::min();
  using signals::Signals;
  EXPECT_EQ(signal(&Signals::hot_spot_yaw), -12346);  // -123.456 deg by 0.01
  EXPECT_EQ(signal(&Signals::hot_spot_pitch), 1234);
  EXPECT_EQ(signal(&Signals::hot_spot_solid_angle), 700);        // 0.7 msr by 0.001
  EXPECT_EQ(signal(&Signals::hot_spot_peak_temperature), -200);  // -20.04 degC by 0.1
  EXPECT_EQ(signal(&Signals::hot_spot_mean_temperature), kNotValid);
  EXPECT_EQ(signal(&Signals::spatter_rate_trend), kNotValid);
}

TEST(ModbusSink, BeforeTheFirstFrameSetNothingIsValidAndTheAgeIsEndless) {
  ModbusSink sink(loopback(), accept_all);
  ASSERT_TRUE(sink.start());
  Plc plc(sink.port());
  ASSERT_EQ(plc.read_input(0, 100), 0);
  EXPECT_EQ(plc.words[0], 2);
  EXPECT_EQ(plc.words[2], 0);  // starting
  EXPECT_EQ(plc.u32(8), 0U);
  EXPECT_EQ(plc.u32(10), 0x7fffffffU);
  EXPECT_EQ(plc.u32(12), 0U);
  EXPECT_EQ(plc.u32(14), 0U);
  for (const int block : {1000, 2000}) {
    ASSERT_EQ(plc.read_input(block, 125), 0);
    for (std::size_t place = 0; place < 20; ++place) EXPECT_EQ(plc.words[place], 0) << place;
    for (std::size_t n = 0; n < signals::kSignals.size(); ++n) {
      EXPECT_EQ(plc.u32(20 + 2 * n), 0x80000000U);
    }
  }
}

TEST(ModbusSink, TheAgeIsOfTheMomentOfTheAnswer) {
  using std::chrono::milliseconds;
  ModbusSink sink(loopback(), accept_all);
  ASSERT_TRUE(sink.start());
  Status status;
  status.frame_set = 1;
  status.stamp = hal::Clock::now() - std::chrono::hours(1);
  sink.accept(status);
  Plc plc(sink.port());
  const auto age = [&] { return duration_cast<milliseconds>(hal::Clock::now() - status.stamp); };
  const auto before = age();
  ASSERT_EQ(plc.read_input(10, 2), 0);
  const std::uint32_t first = plc.u32(0);
  EXPECT_GE(first, before.count());
  EXPECT_LE(first, age().count());
  // It grows although nobody tells the server anything.
  EXPECT_TRUE(eventually([&] { return plc.read_input(10, 2) == 0 && plc.u32(0) > first; }));
}

TEST(ModbusSink, TheUtcStampOfAFrameSetIsTrueAndStays) {
  ModbusSink sink(loopback(), accept_all);
  ASSERT_TRUE(sink.start());
  Status status;
  status.frame_set = 1;
  status.stamp = hal::Clock::now();
  const auto utc = std::chrono::system_clock::now().time_since_epoch();
  sink.accept(status);
  Plc plc(sink.port());
  ASSERT_EQ(plc.read_input(12, 4), 0);
  const double seconds = plc.u32(0) + plc.u32(2) * 1e-6;
  EXPECT_NEAR(seconds, std::chrono::duration<double>(utc).count(), 0.5);
  // Computed anew for each status it would come out a microsecond different now and then.
  for (int set = 2; set < 300; ++set) {
    status.frame_set = static_cast<std::uint64_t>(set);
    status.stamp = hal::Clock::now();
    sink.accept(status);
    ASSERT_EQ(plc.read_input(12, 4), 0);
    const tests::Words first = plc.words;
    for (int repetition = 0; repetition < 5; ++repetition) {
      ++status.heartbeat;
      sink.accept(status);
      ASSERT_EQ(plc.read_input(12, 4), 0);
      ASSERT_EQ(plc.words, first);
    }
  }
}

TEST(ModbusSink, SaysSoWhenThePipelineIsSilent) {
  ModbusSettings settings = loopback();
  settings.status_timeout = std::chrono::milliseconds(1);
  ModbusSink sink(settings, accept_all);
  ASSERT_TRUE(sink.start());
  Status status = tests::example_status();
  status.state = SystemState::Running;
  sink.accept(status);
  Plc plc(sink.port());
  ASSERT_TRUE(eventually([&] { return plc.read_discrete(4, 1) == 0 && plc.bits[0] == 1; }));
  ASSERT_EQ(plc.read_input(0, 100), 0);
  EXPECT_EQ(plc.words[2], 3);
  EXPECT_EQ(plc.words[3], 0b1011'0100);  // fault, stale, process active, result available
  EXPECT_EQ(plc.words[4], 0);            // nobody knows whether the cameras still deliver
  EXPECT_EQ(plc.words[5] & 1, 1);        // pipeline silent
  EXPECT_EQ(plc.u32(8), 0x80010203U);    // the last frame set is still the last one
  ASSERT_EQ(plc.read_input(1000, 125), 0);
  EXPECT_EQ(plc.words[13], 0);  // quality: not measured
  for (std::size_t word = 16; word < 20; ++word) EXPECT_EQ(plc.words[word], 0);
  EXPECT_EQ(plc.u32(20 + 2 * 11), 0x80000000U);
  // A result that waits is history, and stays what it was.
  ASSERT_EQ(plc.read_input(2000, 125), 0);
  EXPECT_EQ(plc.u32(0), 0x0013'0016U);
  EXPECT_EQ(plc.words[13], 1);
  EXPECT_EQ(plc.i32(20 + 2 * 11), -12346);  // hot_spot_yaw
}

/// A code in the signal's range that tells of the frame set's number.
std::uint32_t code_of(std::uint32_t number, const signals::SignalInfo& signal) {
  return number % static_cast<std::uint32_t>(signal.maximum / signal.scale);
}

/// Every figure follows from the number of the frame set.
Status status_of(std::uint32_t number) {
  Status status;
  status.frame_set = number;
  status.heartbeat = number;
  status.overruns = number;
  status.camera_count = kMaxCameras;
  for (auto& camera : status.cameras) camera.frames = number;
  for (const auto& signal : signals::kSignals) {
    for (auto& region : status.regions) {
      region.signals.*signal.member = code_of(number, signal) * signal.scale;
    }
  }
  return status;
}

TEST(ModbusSink, NoAnswerMixesTwoFrameSets) {
  ModbusSink sink(loopback(), accept_all);
  ASSERT_TRUE(sink.start());
  const std::jthread pipeline([&](const std::stop_token& stop) {
    for (std::uint32_t number = 1; !stop.stop_requested(); ++number) sink.accept(status_of(number));
  });
  Plc plc(sink.port());
  ASSERT_TRUE(eventually([&] { return plc.read_input(8, 2) == 0 && plc.u32(0) > 0; }));
  std::uint32_t last = 0;
  int changes = 0;
  for (int i = 0; i < 3000; ++i) {
    ASSERT_EQ(plc.read_input(0, 100), 0);
    std::uint32_t number = plc.u32(8);
    ASSERT_EQ(plc.words[1], number & 0xffff);
    ASSERT_EQ(plc.u32(30), number);  // overruns
    ASSERT_EQ(plc.read_input(1128, 125), 0);
    number = plc.u32(2);
    for (std::size_t n = 0; n < signals::kSignals.size(); ++n) {
      ASSERT_EQ(plc.u32(20 + 2 * n), code_of(number, signals::kSignals[n]));
    }
    changes += number != last ? 1 : 0;
    last = number;
    ASSERT_EQ(plc.read_input(200, 125), 0);
    for (std::size_t camera = 1; camera < 3; ++camera) {
      ASSERT_EQ(plc.u32(32 * camera + 6), plc.u32(6));  // frames
    }
  }
  EXPECT_GT(changes, 10);
}

TEST(ModbusSink, EveryMappedPlaceIsReadableAndNoOther) {
  ModbusSink sink(loopback(), accept_all);
  ASSERT_TRUE(sink.start());
  Plc plc(sink.port());
  const modbus::RegisterMap map;
  using modbus::Table;
  for (int address = 0; address < 7600; ++address) {
    const auto expected = [&](Table table) { return map.find(table, address) ? 0 : 2; };
    ASSERT_EQ(plc.read_bits(address, 1), expected(Table::Coil)) << address;
    ASSERT_EQ(plc.read_discrete(address, 1), expected(Table::Discrete)) << address;
    ASSERT_EQ(plc.read_holding(address, 1), expected(Table::Holding)) << address;
    ASSERT_EQ(plc.read_input(address, 1), expected(Table::Input)) << address;
  }
  EXPECT_EQ(plc.read_input(0, 125), 0);
  EXPECT_EQ(plc.read_input(310, 20), 2);  // beyond the last camera
  EXPECT_EQ(plc.read_input(65535, 2), 2);
}

TEST(ModbusSink, CountsWhatItServes) {
  ModbusSink sink(loopback(), accept_all);
  ASSERT_TRUE(sink.start());
  Plc plc(sink.port());
  ASSERT_EQ(plc.read_input(0, 1), 0);
  ASSERT_EQ(plc.read_input(999, 2), 0);
  ASSERT_EQ(plc.read_input(999 + 2000, 1), 2);
  ASSERT_EQ(plc.read_input(38, 13), 0);
  EXPECT_EQ(plc.u32(0), 3U);  // answered before this request
  EXPECT_EQ(plc.u32(2), 1U);
  EXPECT_EQ(plc.u32(4), 0U);
  EXPECT_EQ(plc.words[12], 1);
  ASSERT_TRUE(eventually([&] { return sink.statistics().answered == 4; }));
  EXPECT_EQ(sink.statistics().refused, 1U);
  EXPECT_EQ(sink.statistics().connections, 1U);
}

TEST(ModbusSink, StartsAndStopsAgain) {
  ModbusSink sink(loopback(), accept_all);
  EXPECT_EQ(sink.port(), 0);
  sink.stop();
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(sink.start());
    ASSERT_TRUE(sink.start());
    tests::RawClient client(sink.port());
    ASSERT_TRUE(client.send(tests::frame({4, 0, 0, 0, 1})));
    EXPECT_EQ(client.receive_pdu(), (tests::Bytes{4, 2, 0, 2}));
    sink.stop();
    EXPECT_TRUE(client.is_closed_by_server());
    EXPECT_EQ(sink.statistics().connections, 0U);
  }
}

TEST(ModbusSink, OpensNothingWhenDisabled) {
  ModbusSettings settings = loopback();
  settings.enabled = false;
  ModbusSink sink(settings, accept_all);
  ASSERT_TRUE(sink.start());
  sink.accept(tests::example_status());
  EXPECT_EQ(sink.port(), 0);
}

TEST(ModbusSink, NamesThePortThatIsInUse) {
  ModbusSink first(loopback(), accept_all);
  ASSERT_TRUE(first.start());
  ModbusSettings settings = loopback();
  settings.port = first.port();
  const std::string error = start_error(settings);
  EXPECT_THAT(error, HasSubstr("127.0.0.1 port " + std::to_string(first.port())));
  EXPECT_THAT(error, HasSubstr("already in use"));
  EXPECT_THAT(error, HasSubstr("another port"));
  // The first one is not disturbed, and the port is free again once it stops.
  EXPECT_EQ(Plc(first.port()).read_input(0, 1), 0);
  first.stop();
  EXPECT_EQ(start_error(settings), "");
}

TEST(ModbusSink, NamesTheSettingThatCannotBe) {
  ModbusSettings settings = loopback();
  settings.address = "machine7";
  EXPECT_THAT(start_error(settings), HasSubstr("'machine7' is not a numeric IP address"));
  settings.address = "192.0.2.1";  // for documentation: nobody's
  EXPECT_THAT(start_error(settings), HasSubstr("192.0.2.1 port 0"));
  settings = loopback();
  settings.port = 65536;
  EXPECT_THAT(start_error(settings), HasSubstr("port 65536"));
  settings.port = -1;
  EXPECT_THAT(start_error(settings), HasSubstr("port -1"));
  settings = loopback();
  settings.max_connections = 0;
  EXPECT_THAT(start_error(settings), HasSubstr("max_connections 0"));
  settings = loopback();
  settings.writers = {"127.0.0.1", "plc"};
  EXPECT_THAT(start_error(settings), HasSubstr("'plc'"));
}

}  // namespace
}  // namespace orbwatch::app
