// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/line_thread.h"

#include <gmock/gmock.h>

#include <condition_variable>
#include <mutex>

#include "hal/lines/pulse_output.h"
#include "hal/lines/simulated_lines.h"
#include "hal/lines/watchdog_output.h"
#include "hal/lines/watched_output.h"
#include "tests/hal/lines/edges.h"

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;

/// Events of other threads; the tests wait for the expected ones.
template <class T>
class Log {
 public:
  void add(T item) {
    const std::lock_guard lock(mutex_);
    items_.push_back(item);
    changed_.notify_all();
  }
  std::vector<T> wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(
        changed_.wait_for(lock, std::chrono::seconds(30), [&] { return items_.size() >= count; }));
    return items_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> items_;
};

std::unique_ptr<WatchedInput> watch(SimulatedLines& lines, const std::string& name,
                                    Log<EdgeEvent>& edges, Log<LineFault>& faults) {
  auto input = std::make_unique<WatchedInput>(
      lines, InputSettings{.address = {.name = name}},
      [&faults](const auto& report) { faults.add(report.fault); }, Clock::now());
  input->subscribe([&edges](const EdgeEvent& edge) { edges.add(edge); });
  return input;
}

TEST(LineThread, HandsOnTheEdgesOfEachLineInOrder) {
  SimulatedLines lines({"A", "B"});
  Log<EdgeEvent> a, b;
  Log<LineFault> faults;
  const auto input_a = watch(lines, "A", a, faults);
  const auto input_b = watch(lines, "B", b, faults);
  LineThread thread;
  thread.watch(*input_a);
  thread.watch(*input_b);
  ASSERT_TRUE(thread.start());
  std::vector<EdgeEvent> expected;
  for (std::size_t i = 0; i < 200; ++i) {
    expected.push_back({edge_to(i % 2 == 0), at(static_cast<double>(i))});
    lines.drive("A", i % 2 == 0, expected.back().stamp);
    lines.drive("B", i % 2 == 0, expected.back().stamp);
    if (i % 10 == 9) {  // before their queues are full
      a.wait_for(i + 1);
      b.wait_for(i + 1);
    }
  }
  EXPECT_EQ(a.wait_for(200), expected);
  EXPECT_EQ(b.wait_for(200), expected);
  thread.stop();
  EXPECT_EQ(input_a->lost() + input_b->lost(), 0U);
}

TEST(LineThread, APulseTrainGoesOverAWire) {
  SimulatedLines lines({"WIRE"});
  Log<EdgeEvent> edges;
  Log<LineFault> faults;
  const auto input = watch(lines, "WIRE", edges, faults);
  LineThread thread;
  PulseOutput::Outputs outputs;
  outputs.push_back(lines.open_output({.address = {.name = "WIRE"}}).value());
  PulseOutput pulses({.period = milliseconds(4), .width = milliseconds(1)}, std::move(outputs),
                     [&thread] { thread.wake(); });
  thread.watch(*input);
  thread.add(pulses);
  ASSERT_TRUE(thread.start());
  const auto heard = edges.wait_for(20);
  thread.stop();
  for (std::size_t i = 0; i < heard.size(); ++i) EXPECT_EQ(heard[i].edge, edge_to(i % 2 == 0));
  EXPECT_GE(pulses.counts().pulses, 10U);
}

TEST(LineThread, ACommandWakesIt) {
  Log<bool> levels;
  SimulatedLines lines({"OUT"}, [&levels](const std::string&, bool level) { levels.add(level); });
  LineThread thread;
  PulseOutput::Outputs outputs;
  outputs.push_back(lines.open_output({.address = {.name = "OUT"}}).value());
  PulseOutput pulse({.width = milliseconds(1)}, std::move(outputs), [&thread] { thread.wake(); });
  thread.add(pulse);
  ASSERT_TRUE(thread.start());
  EXPECT_TRUE(pulse.fire(Clock::now()));
  EXPECT_THAT(levels.wait_for(2), testing::ElementsAre(true, false));
  thread.stop();
}

TEST(LineThread, TheHeartbeatFallsLowWhenNobodyReports) {
  Log<bool> levels;
  SimulatedLines lines({"OK"}, [&levels](const std::string&, bool level) { levels.add(level); });
  LineThread thread;
  WatchdogOutput ok({.timeout = milliseconds(20)},
                    lines.open_output({.address = {.name = "OK"}}).value(),
                    [&thread] { thread.wake(); });
  thread.add(ok);
  ASSERT_TRUE(thread.start());
  ok.report(true, Clock::now());
  EXPECT_THAT(levels.wait_for(2), testing::ElementsAre(true, false));
  EXPECT_FALSE(lines.level("OK"));
  thread.stop();
}

TEST(LineThread, ALineThatComesBackIsHeardAgain) {
  SimulatedLines lines({"IN", "OTHER"});
  Log<EdgeEvent> edges, other_edges;
  Log<LineFault> faults, other_faults;
  const auto input = watch(lines, "IN", edges, faults);
  const auto other = watch(lines, "OTHER", other_edges, other_faults);
  LineThread thread;
  thread.watch(*input);
  thread.watch(*other);
  ASSERT_TRUE(thread.start());
  lines.fail_with("IN", LineFault::Gone);
  faults.wait_for(1);
  lines.drive("OTHER", true, at(1));
  other_edges.wait_for(1);
  lines.fail_with("IN", LineFault::None);
  faults.wait_for(2);
  lines.drive("IN", true, at(2));
  edges.wait_for(1);
  thread.stop();
  EXPECT_EQ(input->opened(), 2U);
  EXPECT_EQ(other->opened(), 1U);
}

TEST(LineThread, AnOutputThatComesLateGetsItsLevel) {
  Log<bool> levels;
  SimulatedLines lines({"OK"}, [&levels](const std::string&, bool level) { levels.add(level); });
  lines.fail_with("OK", LineFault::Gone);
  Log<LineFault> faults;
  auto output = std::make_unique<WatchedOutput>(
      lines, OutputSettings{.address = {.name = "OK"}},
      [&faults](const auto& report) { faults.add(report.fault); }, Clock::now());
  LineThread thread;
  thread.add(*output);
  WatchdogOutput ok({.timeout = std::chrono::minutes(1)}, std::move(output),
                    [&thread] { thread.wake(); });
  thread.add(ok);
  ASSERT_TRUE(thread.start());
  ok.report(true, Clock::now());
  EXPECT_THAT(faults.wait_for(1), testing::ElementsAre(LineFault::Gone));
  lines.fail_with("OK", LineFault::None);
  EXPECT_THAT(levels.wait_for(1), testing::ElementsAre(true));
  thread.stop();
}

TEST(LineThread, StopsTwiceAndStartsAgain) {
  SimulatedLines lines({"IN"});
  Log<EdgeEvent> edges;
  Log<LineFault> faults;
  const auto input = watch(lines, "IN", edges, faults);
  LineThread thread;
  thread.watch(*input);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(thread.start());
    lines.drive("IN", i % 2 == 0, at(i));
    edges.wait_for(static_cast<std::size_t>(i) + 1);
    thread.stop();
    thread.stop();
  }
}

}  // namespace
}  // namespace orbwatch::hal
