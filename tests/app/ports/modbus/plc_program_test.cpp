// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>

#include "tests/app/ports/modbus/clients.h"
#include "tests/support/reference_data.h"
#include "tests/support/share.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

using orbwatch::tests::Subprocess;

/// The status of result n, reported while it is the newest one. Every figure is computed from n and
/// the region.
Status status_of(std::uint64_t n) {
  Status status;
  status.result = status.trigger = n;
  status.frame_set = 10 * n;
  status.stamp = hal::Clock::now();
  status.configuration_checksum = static_cast<std::uint32_t>(7 * n);
  status.recipe = static_cast<std::uint16_t>(n % 1000);
  status.process_active = n % 2 == 1;
  for (std::size_t region = 0; region < signals::kMaxRegions; ++region) {
    status.regions[region].quality = Quality::Good;
    for (const auto& signal : signals::kSignals) {
      const auto codes = static_cast<std::uint64_t>(signal.maximum / signal.scale);
      status.regions[region].signals.*signal.member =
          static_cast<double>((n + region) % codes) * signal.scale;
    }
  }
  return status;
}

/// Replaces the pipeline: a result for each trigger, on a separate thread, and frame sets without a
/// result in between.
class Part : public testing::Test {
 protected:
  void SetUp() override {
    ORBWATCH_REQUIRE_FILE("/usr/lib/python3/dist-packages/pymodbus");
    const auto started = sink_.start();
    ASSERT_TRUE(started) << started.error().message;
    pipeline_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  CommandResult carry_out(const Command& command) {
    if (command.code != CommandCode::Trigger) return CommandResult::NotPossible;
    {
      const std::lock_guard lock(mutex_);
      ++triggers_;
    }
    triggered_.notify_one();
    return CommandResult::Done;
  }

  void run(const std::stop_token& stop) {
    for (std::uint64_t n = 1;; ++n) {
      std::unique_lock lock(mutex_);
      if (!triggered_.wait(lock, stop, [&] { return triggers_ >= n; })) return;
      lock.unlock();
      const Status status = status_of(n);
      sink_.accept(status);
      Status later = status;  // is not a result
      later.trigger = 0;
      for (int i = 0; i < 2; ++i) {
        ++later.frame_set;
        ++later.heartbeat;
        later.stamp += std::chrono::milliseconds(1);
        later.regions = {};
        sink_.accept(later);
      }
    }
  }

  /// Counts of the PLC.
  struct Counts {
    int triggered = -1, parts = -1, lost = -1, again = -1;
  };
  Counts produce(int parts, const std::string& option = "") {
    std::vector<std::string> words{"/usr/bin/python3",
                                   ORBWATCH_SOURCE_DIR "/tests/app/ports/modbus/plc_program.py",
                                   std::to_string(sink_.port()), std::to_string(parts), "20240507"};
    if (!option.empty()) words.push_back(option);
    Subprocess plc(words, folder_.path() / "plc.log");
    EXPECT_EQ(plc.wait(), 0) << plc.output();
    Counts counts;
    std::sscanf(plc.output().c_str(), "triggered %d parts %d lost %d again %d", &counts.triggered,
                &counts.parts, &counts.lost, &counts.again);
    return counts;
  }

  orbwatch::tests::TemporaryFolder folder_;
  std::mutex mutex_;
  std::condition_variable_any triggered_;
  std::uint64_t triggers_ = 0;
  ModbusSink sink_{tests::loopback(),
                   [this](const Command& command) { return carry_out(command); }};
  std::jthread pipeline_;
};

TEST_F(Part, OfAThousandNoneIsLostOrDoubled) {
  const int parts = orbwatch::tests::share_of(1000);
  const Counts counts = produce(parts);
  EXPECT_EQ(counts.triggered, parts);
  EXPECT_EQ(counts.parts, parts);
  EXPECT_EQ(counts.lost, 0);
  EXPECT_GT(counts.again, 0) << "no connection was lost at the wrong moment";
}

TEST_F(Part, BurstsBetweenTwoScansWait) {
  const int parts = orbwatch::tests::share_of(1000);
  const Counts counts = produce(parts, "--slow");
  EXPECT_EQ(counts.parts, parts);
  EXPECT_EQ(counts.lost, 0);
}

TEST_F(Part, MoreThanWaitAreRefusedAndCounted) {
  const Counts counts = produce(500, "--overrun");
  EXPECT_EQ(counts.triggered, 500);
  EXPECT_GT(counts.lost, 50);
  EXPECT_EQ(counts.parts + counts.lost, 500);
}

TEST_F(Part, EveryRowIsReadAndWrittenByPymodbus) {
  sink_.accept(tests::example_status());
  Subprocess walk(
      {"/usr/bin/python3", ORBWATCH_SOURCE_DIR "/tests/app/ports/modbus/walk_registers.py",
       std::to_string(sink_.port())},
      folder_.path() / "walk.log");
  EXPECT_EQ(walk.wait(), 0) << walk.output();
}

}  // namespace
}  // namespace orbwatch::app
