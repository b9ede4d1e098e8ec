// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>

#include "tests/app/ports/modbus/clients.h"
#include "tests/support/reference_data.h"

namespace orbwatch::app {
namespace {

using tests::address_of;

constexpr const char* kMbpoll = "/usr/bin/mbpoll";

/// Exit code of mbpoll and the values read, by address.
struct Polled {
  int exit_code = -1;
  std::string text;
  std::map<int, long> values;
};

Polled run(const std::string& command) {
  Polled polled;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return polled;
  char line[512];
  while (std::fgets(line, sizeof(line), pipe)) {
    polled.text += line;
    int address = 0;
    long value = 0;
    if (std::sscanf(line, "[%d]: %ld", &address, &value) == 2) polled.values[address] = value;
  }
  const int status = ::pclose(pipe);
  polled.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return polled;
}

/// A server and mbpoll, a client that shares only libmodbus' encoding with our code.
class Mbpoll : public testing::Test {
 protected:
  void SetUp() override {
    ORBWATCH_REQUIRE_FILE(kMbpoll);
    const auto started = sink_.start();
    ASSERT_TRUE(started) << started.error().message;
    sink_.accept(tests::example_status());
  }

  Polled poll(const std::string& options, const std::string& values = {}) {
    return run(std::string(kMbpoll) + " -0 -1 -o 10 -p " + std::to_string(sink_.port()) + " " +
               options + " 127.0.0.1 " + values);
  }

  ModbusSink sink_{tests::loopback(), [](const Command& command) {
                     return command.arguments[0] == 7 ? CommandResult::ArgumentOutOfRange
                                                      : CommandResult::Done;
                   }};
};

TEST_F(Mbpoll, ReadsHeartbeatAndInputs) {
  const auto read = [this](const char* name, const std::string& type) {
    const int address = address_of(name);
    return poll(type + " -r " + std::to_string(address) + " -c 1").values[address];
  };
  const std::string uint = "-t 3";
  const std::string udint = "-t 3:int -B";
  EXPECT_EQ(read("map_version", uint), 3);
  EXPECT_EQ(read("system_heartbeat", udint), 0x0001'0102);
  EXPECT_EQ(read("system_state", uint), 2);
  EXPECT_EQ(read("status_bits", udint), 0b1010'0010);
  EXPECT_EQ(read("measurement_bits", udint), 0b1'0000'0001);
  EXPECT_EQ(read("fault_bits", udint), 0b10'0000'0000'0000'0000);
  EXPECT_EQ(read("system_recipe", uint), 7);
  EXPECT_EQ(read("system_selected_view", uint), 2);
  Status status = tests::example_status();
  ++status.heartbeat;
  sink_.accept(status);
  EXPECT_EQ(read("system_heartbeat", udint), 0x0001'0103);
}

TEST_F(Mbpoll, ReadsDiscreteInputsAndTheirMirror) {
  const Polled polled = poll("-t 1 -r 0 -c 16");
  ASSERT_EQ(polled.exit_code, 0) << polled.text;
  ASSERT_EQ(polled.values.size(), 16U);
  for (const auto& [address, value] : polled.values) {
    EXPECT_EQ(value, address == 1 || address == 5 || address == 7 ? 1 : 0) << address;
  }
  EXPECT_EQ(poll("-t 0 -r 5005 -c 1").values[5005], 1);
}

TEST_F(Mbpoll, ReadsSignalsAsDoubleWordsAlsoFromTheMirror) {
  const int yaw = address_of("region_0_hot_spot_yaw");
  const int orientation = address_of("region_0_hot_spot_orientation");
  const Polled polled = poll("-t 3:int -B -r " + std::to_string(yaw) + " -c 1");
  ASSERT_EQ(polled.exit_code, 0) << polled.text;
  EXPECT_EQ(polled.values.at(yaw), -12346);
  const auto mirror = [this](int address) {
    const int place = address + modbus::kMirrorOffset;
    return poll("-t 4:int -B -r " + std::to_string(place) + " -c 1").values[place];
  };
  EXPECT_EQ(mirror(yaw), -12346);
  EXPECT_EQ(mirror(orientation), -2147483648L);
}

TEST_F(Mbpoll, GivesACommandAndSeesItAcknowledged) {
  const std::string arguments = "-t 4 -r " + std::to_string(address_of("argument_0"));
  const int first = address_of("acknowledged_sequence");
  const std::string answer = "-t 4 -r " + std::to_string(first) + " -c 3";
  ASSERT_EQ(poll(arguments, "0 2").exit_code, 0);
  ASSERT_EQ(poll("-t 4 -r " + std::to_string(address_of("command")), "1 41").exit_code, 0);
  const auto is_answered = [&](const std::map<int, long>& values) {
    return tests::eventually([&] { return poll(answer).values == values; });
  };
  EXPECT_TRUE(is_answered({{first, 41}, {first + 1, 0}, {first + 2, 1}})) << poll(answer).text;
  ASSERT_EQ(poll(arguments, "0 7 0 0 0 0 0 0 0 0 0 1 42").exit_code, 0);
  EXPECT_TRUE(is_answered({{first, 42}, {first + 1, 2}, {first + 2, 1}})) << poll(answer).text;
}

TEST_F(Mbpoll, ReadsAResultAndAcknowledgesIt) {
  constexpr long kNumber = 0x0013'0016;
  const auto read = [this](int table, int address) {
    const std::string type = "-t " + std::to_string(table) + ":int -B -r ";
    return poll(type + std::to_string(address) + " -c 1").values[address];
  };
  const int window = address_of("result_0_result");
  const int acknowledged = address_of("result_acknowledged");
  const std::string acknowledge = "-t 4:int -B -r " + std::to_string(acknowledged);
  EXPECT_EQ(read(3, window), kNumber);
  ASSERT_EQ(poll(acknowledge, std::to_string(kNumber - 1)).exit_code, 0);
  EXPECT_EQ(read(4, window + modbus::kMirrorOffset), kNumber);
  ASSERT_EQ(poll(acknowledge, std::to_string(kNumber)).exit_code, 0);
  EXPECT_EQ(read(3, window), 0);
  EXPECT_EQ(read(4, acknowledged), kNumber);
}

TEST_F(Mbpoll, SeesExceptions) {
  EXPECT_NE(poll("-t 3 -r 5000 -c 1").text.find("Illegal data address"), std::string::npos);
  EXPECT_NE(poll("-t 4 -r 0", "5").text.find("Illegal data address"), std::string::npos);
  EXPECT_NE(poll("-t 4 -r " + std::to_string(address_of("command")), "99")
                .text.find("Illegal data value"),
            std::string::npos);
}

TEST_F(Mbpoll, TheManualsExamplesWork) {
  std::ifstream manual(std::string(ORBWATCH_SOURCE_DIR) + "/app/ports/modbus/registers.md");
  const std::string port = std::to_string(ModbusSettings{}.port);
  int examples = 0;
  for (std::string line; std::getline(manual, line);) {
    if (!line.starts_with("mbpoll ")) continue;
    line.resize(std::min(line.find('#'), line.size()));
    ASSERT_NE(line.find(port), line.npos) << line;
    line.replace(line.find(port), port.size(), std::to_string(sink_.port()));
    ASSERT_NE(line.find("<host>"), line.npos) << line;
    line.replace(line.find("<host>"), 6, "127.0.0.1");
    const Polled polled = run(line);
    EXPECT_EQ(polled.exit_code, 0) << line << "\n" << polled.text;
    ++examples;
  }
  EXPECT_GE(examples, 12);
}

}  // namespace
}  // namespace orbwatch::app
