#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>

#include "clients.h"
#include "tests/support/reference_data.h"

namespace orbwatch::app {
namespace {

constexpr const char* kMbpoll = "/usr/bin/mbpoll";

/// How a run of mbpoll ended, and what it read: by address.
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

/// A server and mbpoll, a client that shares no code with ours beyond libmodbus' encoding.
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
  const Polled polled = poll("-t 3 -r 0 -c 8");
  ASSERT_EQ(polled.exit_code, 0) << polled.text;
  const std::map<int, long> expected{
      {0, 2}, {1, 0x0102}, {2, 2}, {3, 0b1010'0010}, {4, 0b1'0000'0001}, {5, 0b10'0000'0000},
      {6, 7}, {7, 2}};
  EXPECT_EQ(polled.values, expected) << polled.text;
  Status status = tests::example_status();
  ++status.heartbeat;
  sink_.accept(status);
  EXPECT_EQ(poll("-t 3 -r 1 -c 1").values[1], 0x0103);
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
  const Polled polled = poll("-t 3:int -B -r 1042 -c 1");
  ASSERT_EQ(polled.exit_code, 0) << polled.text;
  EXPECT_EQ(polled.values.at(1042), -12346);
  EXPECT_EQ(poll("-t 4:int -B -r 6042 -c 1").values[6042], -12346);
  EXPECT_EQ(poll("-t 4:int -B -r 6038 -c 1").values[6038], -2147483648L);
}

TEST_F(Mbpoll, GivesACommandAndSeesItAcknowledged) {
  ASSERT_EQ(poll("-t 4 -r 0", "0 2").exit_code, 0);
  ASSERT_EQ(poll("-t 4 -r 11", "1 41").exit_code, 0);
  Polled polled = poll("-t 4 -r 13 -c 3");
  const std::map<int, long> done{{13, 41}, {14, 0}, {15, 1}};
  EXPECT_EQ(polled.values, done) << polled.text;
  ASSERT_EQ(poll("-t 4 -r 0", "0 7 0 0 0 0 0 0 0 0 0 1 42").exit_code, 0);
  polled = poll("-t 4 -r 13 -c 3");
  const std::map<int, long> refused{{13, 42}, {14, 2}, {15, 1}};
  EXPECT_EQ(polled.values, refused) << polled.text;
}

TEST_F(Mbpoll, ReadsAResultAndTakesIt) {
  constexpr long kNumber = 0x0013'0016;
  EXPECT_EQ(poll("-t 3:int -B -r 2000 -c 1").values[2000], kNumber);
  ASSERT_EQ(poll("-t 4:int -B -r 8", std::to_string(kNumber - 1)).exit_code, 0);
  EXPECT_EQ(poll("-t 4:int -B -r 7000 -c 1").values[7000], kNumber);
  ASSERT_EQ(poll("-t 4:int -B -r 8", std::to_string(kNumber)).exit_code, 0);
  EXPECT_EQ(poll("-t 3:int -B -r 2000 -c 1").values[2000], 0);
  EXPECT_EQ(poll("-t 4:int -B -r 8 -c 1").values[8], kNumber);
}

TEST_F(Mbpoll, SeesExceptions) {
  EXPECT_NE(poll("-t 3 -r 328 -c 1").text.find("Illegal data address"), std::string::npos);
  EXPECT_NE(poll("-t 4 -r 0", "5").text.find("Illegal data address"), std::string::npos);
  EXPECT_NE(poll("-t 4 -r 11", "99").text.find("Illegal data value"), std::string::npos);
}

TEST_F(Mbpoll, TheManualsExamplesWork) {
  std::ifstream manual(std::string(ORBWATCH_SOURCE_DIR) + "/app/modbus/registers.md");
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
