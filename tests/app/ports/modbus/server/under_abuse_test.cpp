// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <tuple>

#include "tests/app/ports/modbus/abuses.h"
#include "tests/app/ports/modbus/clients.h"
#include "tests/support/sanitizers.h"
#include "tests/support/share.h"

namespace orbwatch::app {
namespace {

using std::chrono::seconds;
using tests::eventually;
using tests::Plc;

/// An abuse, and whether its clients have the PLC's permission to write.
using Case = std::tuple<orbwatch::tests::Abuse, bool>;

/// Duration of an abuse: random frames for a minute, or the share of it that runs.
seconds duration(const Case& abuse) {
  const bool is_long = std::get<0>(abuse).name == "random frames" && std::get<1>(abuse);
  return seconds(is_long && !orbwatch::tests::kHasThreadSanitizer ? orbwatch::tests::share_of(60)
                                                                  : 1);
}

std::ptrdiff_t open_files() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

/// Resident memory, bytes.
long resident() {
  std::ifstream file("/proc/self/statm");
  long size = 0;
  long pages = 0;
  file >> size >> pages;
  return pages * ::sysconf(_SC_PAGESIZE);
}

class ModbusUnderAbuse : public testing::TestWithParam<Case> {};

TEST_P(ModbusUnderAbuse, AHealthyClientIsAlwaysAnsweredAndNothingIsKept) {
  ModbusSettings settings = tests::loopback();
  settings.frame_timeout = std::chrono::milliseconds(200);
  const auto& [abuse, all_may_write] = GetParam();
  if (!all_may_write) settings.writers = {"127.0.0.1"};
  ModbusSink sink(settings, tests::accept_all);
  ASSERT_TRUE(sink.start());
  sink.accept(tests::example_status());
  Plc plc(sink.port());
  const auto ask = [&] {
    return plc.read_input(tests::address_of("system_heartbeat"), 2) == 0 &&
           plc.u32(0) == 0x0001'0102;
  };
  ASSERT_TRUE(ask());
  const std::ptrdiff_t files = open_files();
  std::uint64_t asked = 1;
  const auto ask_for = [&](seconds time) {
    const auto end = hal::Clock::now() + time;
    while (hal::Clock::now() < end) {
      ASSERT_TRUE(ask()) << "request " << asked;
      ++asked;
    }
  };
  modbus::ServerStatus statistics;
  {
    orbwatch::tests::Abused abused(abuse, sink.port());
    ASSERT_NO_FATAL_FAILURE(ask_for(seconds(1)));
    const long before = resident();
    ASSERT_NO_FATAL_FAILURE(ask_for(duration(GetParam())));
    if (!orbwatch::tests::kIsSanitized) {
      EXPECT_LT(resident() - before, 2'000'000) << "more than sockets can explain";
    }
    EXPECT_GT(abused.acts(), 10U);
    statistics = sink.statistics();  // before the clients disconnect
  }
  EXPECT_TRUE(eventually([&] { return sink.statistics().connections == 1; }));
  EXPECT_TRUE(eventually([&] { return open_files() == files; })) << open_files() << " of " << files;
  EXPECT_GE(statistics.answered + 1, asked) << "all but the last must be counted by now";
  if (abuse.is_allowed) {
    EXPECT_EQ(statistics.refused + statistics.dropped, 0U);
    EXPECT_GT(statistics.answered, 2 * asked);
  } else {
    EXPECT_GT(statistics.refused + statistics.dropped, 10U);
  }
  EXPECT_TRUE(ask());
}

INSTANTIATE_TEST_SUITE_P(, ModbusUnderAbuse,
                         testing::Combine(testing::ValuesIn(tests::abuses()), testing::Bool()),
                         [](const auto& abuse) {
                           std::string name(std::get<0>(abuse.param).name);
                           std::erase_if(name, [](char c) { return c == ' '; });
                           return name + (std::get<1>(abuse.param) ? "OfWriters" : "OfReaders");
                         });

}  // namespace
}  // namespace orbwatch::app
