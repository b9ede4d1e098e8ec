// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/modbus_sink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <thread>

#include "tests/app/ports/modbus/clients.h"

namespace orbwatch::app {
namespace {

using testing::HasSubstr;
using tests::accept_all;
using tests::address_of;
using tests::eventually;
using tests::loopback;
using tests::place_of;
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
  ASSERT_EQ(plc.read_input(address_of("region_0_result"), 124), 0);
  const auto place = [](const std::string& name) {
    return place_of("region_0_" + name, "region_0_result");
  };
  EXPECT_EQ(plc.u32(place("result")), 0x0013'0016U);
  EXPECT_EQ(plc.u32(place("frame_set")), 0x8001'0203U);
  EXPECT_EQ(plc.u32(place("trigger")), 0x0012'0015U);
  EXPECT_EQ(plc.u32(place("configuration_checksum")), 0x89ab'cdefU);
  EXPECT_EQ(plc.words[place("recipe")], 7);
  EXPECT_EQ(plc.words[place("quality")], 1);
  EXPECT_EQ(plc.words[place("process_active")], 1);
  const auto signal = [&](double signals::Signals::*member) {
    std::size_t n = 0;
    while (signals::kSignals[n].member != member) ++n;
    const bool is_valid = (plc.words[place("valid_0") + n / 16] >> n % 16 & 1) != 0;
    const std::size_t at = place(std::string(signals::kSignals[n].name));
    EXPECT_EQ(is_valid, plc.u32(at) != 0x80000000U) << signals::kSignals[n].name;
    return plc.i32(at);
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
  ASSERT_EQ(plc.read_input(0, 124), 0);
  const auto place = [](const char* name) { return static_cast<std::size_t>(address_of(name)); };
  EXPECT_EQ(plc.words[place("map_version")], 3);
  EXPECT_EQ(plc.words[place("system_state")], 0);  // starting
  EXPECT_EQ(plc.u32(place("system_frame_set")), 0U);
  EXPECT_EQ(plc.u32(place("system_stamp_age")), 0x7fffffffU);
  EXPECT_EQ(plc.u32(place("utc_seconds")), 0U);
  EXPECT_EQ(plc.u32(place("utc_microseconds")), 0U);
  for (const std::string window : {"region_0_", "result_0_"}) {
    const int begin = address_of(window + "result");
    ASSERT_EQ(plc.read_input(begin, 124), 0);
    const std::size_t header = place_of(window + "hot_spot_present", window + "result");
    EXPECT_EQ(header, 20U);
    for (std::size_t at = 0; at < header; ++at) EXPECT_EQ(plc.words[at], 0) << at;
    for (std::size_t n = 0; n < modbus::kFirstSignals; ++n) {
      const std::string name = window + std::string(signals::kSignals[n].name);
      EXPECT_EQ(plc.u32(place_of(name, window + "result")), 0x80000000U) << name;
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
  const int register_of_age = address_of("system_stamp_age");
  ASSERT_EQ(plc.read_input(register_of_age, 2), 0);
  const std::uint32_t first = plc.u32(0);
  EXPECT_GE(first, before.count());
  EXPECT_LE(first, age().count());
  // The age increases although the server gets no status.
  EXPECT_TRUE(
      eventually([&] { return plc.read_input(register_of_age, 2) == 0 && plc.u32(0) > first; }));
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
  const int utc_seconds = address_of("utc_seconds");
  ASSERT_EQ(address_of("utc_microseconds"), utc_seconds + 2);
  ASSERT_EQ(plc.read_input(utc_seconds, 4), 0);
  const double seconds = plc.u32(0) + plc.u32(2) * 1e-6;
  EXPECT_NEAR(seconds, std::chrono::duration<double>(utc).count(), 0.5);
  // A conversion for each status would occasionally differ by a microsecond.
  for (int set = 2; set < 300; ++set) {
    status.frame_set = static_cast<std::uint64_t>(set);
    status.stamp = hal::Clock::now();
    sink.accept(status);
    ASSERT_EQ(plc.read_input(utc_seconds, 4), 0);
    const tests::Words first = plc.words;
    for (int repetition = 0; repetition < 5; ++repetition) {
      ++status.heartbeat;
      sink.accept(status);
      ASSERT_EQ(plc.read_input(utc_seconds, 4), 0);
      ASSERT_EQ(plc.words, first);
    }
  }
}

/// True once bit `stale` is set.
bool is_stale(Plc& plc) {
  return eventually(
      [&] { return plc.read_discrete(tests::bit_of("stale"), 1) == 0 && plc.bits[0] == 1; });
}

TEST(ModbusSink, SaysSoWhenThePipelineIsSilent) {
  ModbusSettings settings = loopback();
  settings.status_timeout = std::chrono::milliseconds(1);
  ModbusSink sink(settings, accept_all);
  ASSERT_TRUE(sink.start());
  Status status = tests::example_status();
  status.state = SystemState::Running;
  status.machine.quality = MachineQuality::Good;
  status.machine.part = PartName::make("bracket").value();
  status.machine.values.x = 12.5;
  status.machine.vx = 3;
  status.machine.states = 40;
  sink.accept(status);
  Plc plc(sink.port());
  ASSERT_TRUE(is_stale(plc));
  ASSERT_EQ(plc.read_input(0, 124), 0);
  const auto place = [](const char* name) { return static_cast<std::size_t>(address_of(name)); };
  EXPECT_EQ(plc.words[place("system_state")], 3);
  // Fault, stale, process active, result available.
  EXPECT_EQ(plc.u32(place("status_bits")), 0b1011'0100U);
  EXPECT_EQ(plc.u32(place("measurement_bits")), 0U);           // the cameras' state is unknown
  EXPECT_EQ(plc.u32(place("fault_bits")) & 0x101U, 0x101U);    // pipeline silent, machine unknown
  EXPECT_EQ(plc.u32(place("system_frame_set")), 0x80010203U);  // still the newest one
  ASSERT_EQ(plc.read_input(address_of("region_0_result"), 124), 0);
  const auto in_region = [](const std::string& name) {
    return place_of("region_0_" + name, "region_0_result");
  };
  EXPECT_EQ(plc.words[in_region("quality")], 0);  // not measured
  for (std::size_t word = 0; word < 4; ++word) EXPECT_EQ(plc.words[in_region("valid_0") + word], 0);
  EXPECT_EQ(plc.u32(in_region("hot_spot_yaw")), 0x80000000U);
  // A waiting result does not change.
  ASSERT_EQ(plc.read_input(address_of("result_0_result"), 124), 0);
  EXPECT_EQ(plc.u32(0), 0x0013'0016U);
  EXPECT_EQ(plc.words[in_region("quality")], 1);
  EXPECT_EQ(plc.i32(in_region("hot_spot_yaw")), -12346);
  const auto in_machine = [](const std::string& name) {
    return place_of("machine_" + name, "machine_quality");
  };
  const int count = static_cast<int>(in_machine("slips")) + 2;
  ASSERT_EQ(plc.read_input(address_of("machine_quality"), count), 0);
  EXPECT_EQ(plc.words[in_machine("quality")], 4);
  EXPECT_EQ(plc.words[in_machine("part_0")], 0);
  EXPECT_EQ(plc.u32(in_machine("x")), 0x80000000U);
  EXPECT_EQ(plc.u32(in_machine("vx")), 0x80000000U);
  EXPECT_EQ(plc.u32(in_machine("states")), 40U) << "a count";
  ASSERT_EQ(plc.read_input(address_of("result_machine_quality"), count), 0);
  EXPECT_EQ(plc.words[in_machine("quality")], 1);
  EXPECT_EQ(plc.words[in_machine("part_0")], 'b' << 8 | 'r');
  EXPECT_EQ(plc.i32(in_machine("x")), 12500);
  EXPECT_EQ(plc.i32(in_machine("vx")), 300);
}

TEST(ModbusSink, ASilentPipelineHasNoMachineThatIsNotConfigured) {
  ModbusSettings settings = loopback();
  settings.status_timeout = std::chrono::milliseconds(1);
  ModbusSink sink(settings, accept_all);
  ASSERT_TRUE(sink.start());
  sink.accept(tests::example_status());
  Plc plc(sink.port());
  ASSERT_TRUE(is_stale(plc));
  ASSERT_EQ(plc.read_input(address_of("machine_quality"), 1), 0);
  EXPECT_EQ(plc.words[0], 0);
  ASSERT_EQ(plc.read_input(address_of("fault_bits"), 2), 0);
  EXPECT_EQ(plc.u32(0) & 0x100U, 0U);
}

/// A code in the signal's range, computed from the number of the frame set.
std::uint32_t code_of(std::uint32_t number, const signals::SignalInfo& signal) {
  return number % static_cast<std::uint32_t>(signal.maximum / signal.scale);
}

/// A status whose figures are computed from the number of the frame set.
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
  const auto place = [](const char* name) { return static_cast<std::size_t>(address_of(name)); };
  ASSERT_TRUE(eventually(
      [&] { return plc.read_input(address_of("system_frame_set"), 2) == 0 && plc.u32(0) > 0; }));
  std::uint32_t last = 0;
  int changes = 0;
  for (int i = 0; i < 3000; ++i) {
    ASSERT_EQ(plc.read_input(0, 124), 0);
    std::uint32_t number = plc.u32(place("system_frame_set"));
    ASSERT_EQ(plc.u32(place("system_heartbeat")), number);
    ASSERT_EQ(plc.u32(place("system_overruns")), number);
    ASSERT_EQ(plc.read_input(address_of("region_1_result"), 124), 0);
    number = plc.u32(place_of("region_1_frame_set", "region_1_result"));
    const std::size_t first = place_of("region_1_hot_spot_present", "region_1_result");
    for (std::size_t n = 0; n < modbus::kFirstSignals; ++n) {
      ASSERT_EQ(plc.u32(first + 2 * n), code_of(number, signals::kSignals[n]));
    }
    changes += number != last ? 1 : 0;
    last = number;
    ASSERT_EQ(plc.read_input(address_of("camera_0_fault"), 120), 0);
    ASSERT_EQ(plc.u32(place_of("camera_1_frames", "camera_0_fault")),
              plc.u32(place_of("camera_0_frames", "camera_0_fault")));
  }
  EXPECT_GT(changes, 10);
}

TEST(ModbusSink, EveryMappedPlaceIsReadableAndNoOther) {
  ModbusSink sink(loopback(), accept_all);
  ASSERT_TRUE(sink.start());
  Plc plc(sink.port());
  const modbus::RegisterMap map;
  using modbus::Table;
  for (int address = 0; address < 10050; ++address) {
    const auto expected = [&](Table table) { return map.find(table, address) ? 0 : 2; };
    ASSERT_EQ(plc.read_bits(address, 1), expected(Table::Coil)) << address;
    ASSERT_EQ(plc.read_discrete(address, 1), expected(Table::Discrete)) << address;
    ASSERT_EQ(plc.read_holding(address, 1), expected(Table::Holding)) << address;
    ASSERT_EQ(plc.read_input(address, 1), expected(Table::Input)) << address;
  }
  EXPECT_EQ(plc.read_input(0, 125), 0);
  EXPECT_EQ(plc.read_input(4990, 20), 2);  // beyond the last region
  EXPECT_EQ(plc.read_input(65535, 2), 2);
}

TEST(ModbusSink, CountsWhatItServes) {
  ModbusSink sink(loopback(), accept_all);
  ASSERT_TRUE(sink.start());
  Plc plc(sink.port());
  ASSERT_EQ(plc.read_input(0, 1), 0);
  ASSERT_EQ(plc.read_input(4998, 2), 0);
  ASSERT_EQ(plc.read_input(5000, 1), 2);
  ASSERT_EQ(plc.read_input(address_of("modbus_answered"), 8), 0);
  const auto place = [](const char* name) { return place_of(name, "modbus_answered"); };
  EXPECT_EQ(plc.u32(place("modbus_answered")), 3U);  // requests before this one
  EXPECT_EQ(plc.u32(place("modbus_refused")), 1U);
  EXPECT_EQ(plc.u32(place("modbus_dropped")), 0U);
  EXPECT_EQ(plc.u32(place("modbus_connections")), 1U);
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
    EXPECT_EQ(tests::receive_pdu(client), (tests::Bytes{4, 2, 0, modbus::kMapVersion}));
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
  // The first server is not disturbed, and the port is free after its stop.
  EXPECT_EQ(Plc(first.port()).read_input(0, 1), 0);
  first.stop();
  EXPECT_EQ(start_error(settings), "");
}

TEST(ModbusSink, NamesTheSettingThatCannotBe) {
  ModbusSettings settings = loopback();
  settings.address = "machine7";
  EXPECT_THAT(start_error(settings), HasSubstr("'machine7' is not a numeric IP address"));
  settings.address = "fe80::1%none0";  // of an interface that is not plugged in
  EXPECT_THAT(start_error(settings), HasSubstr("'fe80::1%none0'"));
  settings.address = "192.0.2.1";  // reserved for documentation
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
