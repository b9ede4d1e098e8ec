// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "hal/lines/frame_trigger.h"
#include "hal/lines/line_thread.h"
#include "tests/hal/lines/drivers/simulated_chip.h"

namespace orbwatch::hal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GpioInputs : public SimulatedChip {
 protected:
  void start(Clock::duration debounce = Clock::duration(0)) {
    InputSettings settings{.address = {.name = "TRIGGER_IN"}};
    settings.debounce = debounce;
    input = std::make_unique<WatchedInput>(
        lines, settings, [this](const LineFaultReport& report) { faults.add(report.fault); },
        Clock::now());
    ASSERT_TRUE(faults.items().empty());
    input->subscribe([this](const EdgeEvent& edge) { edges.add(edge); });
    thread.watch(*input);
    ASSERT_TRUE(thread.start());
  }

  std::unique_ptr<WatchedInput> input;
  Heard<EdgeEvent> edges;
  Heard<LineFault> faults;
  LineThread thread;  // destroyed before the objects that it uses
};

TEST_F(GpioInputs, TheChipIsListedWithItsLines) {
  const auto held = lines.open_output({.address = {.name = "TRIGGER_OUT"}});
  ASSERT_TRUE(held) << held.error().message;
  for (const ChipInfo& chip : lines.chips()) {
    if (chip.label != "orbwatch") continue;
    ASSERT_EQ(chip.lines.size(), 8U);
    EXPECT_EQ(chip.lines[kInput].name, "TRIGGER_IN");
    EXPECT_FALSE(chip.lines[kInput].is_used);
    EXPECT_EQ(chip.lines[kOutput].consumer, "orbwatch");
    EXPECT_TRUE(chip.lines[kOutput].is_output);
    EXPECT_EQ(chip.lines[kUnnamed].name, "");
    return;
  }
  FAIL() << "no chip has the label orbwatch";
}

TEST_F(GpioInputs, EdgesComeInOrderWithTheKernelsStamps) {
  start();
  for (std::size_t i = 0; i < 40; ++i) {
    const TimePoint before = Clock::now();
    pull(kInput, i % 2 == 0);
    ASSERT_TRUE(edges.wait_for(i + 1));
    const EdgeEvent edge = edges.items().back();
    EXPECT_EQ(edge.edge, edge_to(i % 2 == 0));
    EXPECT_GE(edge.stamp, before);
    EXPECT_LE(edge.stamp, Clock::now());
  }
  EXPECT_EQ(edges.items().size(), 40U);
}

/// Runs without the filter, whose reading of the level counts an edge as lost that a busy kernel
/// delivers late.
TEST_F(GpioInputs, NoEdgeOfAPacedLineIsLost) {
  const auto line = lines.open_input({.address = {.name = "TRIGGER_IN"}});
  ASSERT_TRUE(line) << line.error().message;
  std::array<EdgeEvent, 2> taken;
  for (int i = 0; i < 40; ++i) {
    pull(kInput, i % 2 == 0);
    pollfd file{(*line)->descriptor(), POLLIN, 0};
    ASSERT_EQ(::poll(&file, 1, 60'000), 1);
    const auto count = (*line)->take(taken);
    ASSERT_TRUE(count);
    ASSERT_EQ(*count, 1U);
    EXPECT_EQ(taken[0].edge, edge_to(i % 2 == 0));
    EXPECT_EQ(taken[0].lost_before, 0U);
  }
}

TEST_F(GpioInputs, TriggersAreFramesAndMissed) {
  FrameTrigger trigger({.mode = TriggerMode::Line}, nullptr);
  InputSettings settings{.address = {.chip = "orbwatch", .offset = kInput}};
  input = std::make_unique<WatchedInput>(
      lines, settings, [](const LineFaultReport&) {}, Clock::now());
  input->subscribe([&trigger, this](const EdgeEvent& edge) {
    trigger.on_edge(edge);
    edges.add(edge);
  });
  thread.watch(*input);
  ASSERT_TRUE(thread.start());
  constexpr std::uint64_t kTriggers = 30;
  std::uint64_t frames = 0;
  for (std::uint64_t i = 1; i <= kTriggers; ++i) {
    // Each edge waits until the previous one was received: the simulated chip keeps one.
    pull(kInput, true);
    ASSERT_TRUE(edges.wait_for(2 * i - 1));
    pull(kInput, false);
    ASSERT_TRUE(edges.wait_for(2 * i));
    EXPECT_EQ(trigger.counts().triggers, i);
    if (i % 3 != 0) continue;  // triggers a camera for every third edge
    ++frames;
    EXPECT_EQ(trigger.claim(Clock::now())->id, i);
  }
  thread.stop();
  EXPECT_EQ(trigger.counts().frames, frames);
  EXPECT_EQ(trigger.counts().missed, kTriggers - frames);
}

TEST_F(GpioInputs, AGlitchStormIsOneEdge) {
  start(std::chrono::seconds(1));
  for (int i = 0; i < 301; ++i) pull(kInput, i % 2 == 0);
  ASSERT_TRUE(edges.wait_for(1));
  for (int i = 0; i < 300; ++i) pull(kInput, i % 2 == 1);  // returns to the old level: no change
  for (int i = 0; i < 301; ++i) pull(kInput, i % 2 == 1);  // ends at the other level
  ASSERT_TRUE(edges.wait_for(2));
  thread.stop();
  const auto heard = edges.items();
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_EQ(heard[0].edge, Edge::Rising);
  EXPECT_EQ(heard[1].edge, Edge::Falling);
  EXPECT_LT(heard[0].stamp, heard[1].stamp);
}

TEST_F(GpioInputs, AStormWithoutDebounceEndsWithTheRightLevel) {
  start();
  for (int i = 0; i < 1001; ++i) pull(kInput, i % 2 == 0);
  EXPECT_TRUE(comes_true(
      [this] { return !edges.items().empty() && edges.items().back().edge == Edge::Rising; }));
  thread.stop();
  const auto heard = edges.items();
  for (std::size_t i = 1; i < heard.size(); ++i) EXPECT_LE(heard[i - 1].stamp, heard[i].stamp);
}

TEST_F(GpioInputs, AfterLostEdgesABusyLineHasTheRightLevel) {
  WatchedInput busy(
      lines, {.address = {.name = "TRIGGER_IN"}}, [](const LineFaultReport&) {}, Clock::now());
  std::optional<EdgeEvent> last;
  busy.subscribe([&last](const EdgeEvent& edge) { last = edge; });
  const auto read_one = [&busy] {
    pollfd file{busy.descriptor(), POLLIN, 0};
    ASSERT_EQ(::poll(&file, 1, 60'000), 1);
    busy.read(Clock::now());
  };
  bool up = false;
  for (const int overflow : {301, 302}) {  // loses an odd, then an even number of edges
    for (int i = 0; i < overflow; ++i) pull(kInput, up = !up);
    read_one();
    // Without run(), the level of a quiet line is not read.
    for (int i = 0; i < 20; ++i) {
      const TimePoint before = Clock::now();
      pull(kInput, up = !up);
      // Repeats until this edge is received: the simulated chip keeps one, and drops others without
      // a trace.
      do {
        read_one();
      } while (!HasFatalFailure() && (!last || last->stamp < before));
      ASSERT_FALSE(HasFatalFailure());
      // This many edges may be inverted: readings ahead of their edges agree by chance.
      if (i < 3 * EdgeFilter::kReadings) continue;
      EXPECT_EQ(last->edge, edge_to(up)) << "edge " << i << " after " << overflow;
    }
  }
}

TEST_F(GpioInputs, AChipThatGoesIsAFaultAndComesBack) {
  start();
  pull(kInput, true);
  ASSERT_TRUE(edges.wait_for(1));
  set_live(false);
  ASSERT_TRUE(faults.wait_for(1));
  set_live(true);
  ASSERT_TRUE(comes_true([this] { return faults.items().back() == LineFault::None; }));
  // The new chip's wire is low: this edge and the next ones are received.
  ASSERT_TRUE(edges.wait_for(2));
  pull(kInput, true);
  ASSERT_TRUE(edges.wait_for(3));
  EXPECT_EQ(edges.items().back().edge, Edge::Rising);
}

TEST_F(GpioInputs, ALineInUseAndALineThatIsNotThereAreExplained) {
  start();
  EXPECT_THAT(lines.open_input({.address = {.name = "TRIGGER_IN"}}).error().message,
              AllOf(HasSubstr("TRIGGER_IN"), HasSubstr("used by \"orbwatch\"")));
  EXPECT_THAT(lines.open_input({.address = {.name = "TRIGGER_INN"}}).error().message,
              AllOf(HasSubstr("TRIGGER_INN"), HasSubstr("TRIGGER_IN, TRIGGER_OUT")));
  EXPECT_THAT(lines.open_input({.address = {.chip = "orbwatch", .offset = 8}}).error().message,
              HasSubstr("orbwatch (8 lines)"));
}

TEST_F(GpioInputs, WithoutPermissionTheGroupIsNamed) {
  std::string message;
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const bool lowered = ::setgid(65534) == 0 && ::setuid(65534) == 0;
    const auto opened = lines.open_input({.address = {.name = "TRIGGER_IN"}});
    const std::string text = !lowered ? "cannot become nobody"
                             : opened ? ""
                                      : opened.error().message;
    const auto written = ::write(pipe[1], text.data(), text.size());
    ::_exit(written == static_cast<ssize_t>(text.size()) ? 0 : 1);
  }
  ::close(pipe[1]);
  char buffer[2048];
  for (ssize_t count = 0; (count = ::read(pipe[0], buffer, sizeof buffer)) > 0;) {
    message.append(buffer, static_cast<std::size_t>(count));
  }
  ::close(pipe[0]);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  EXPECT_THAT(message, AllOf(HasSubstr("/dev/gpiochip"), HasSubstr("no permission"),
                             HasSubstr("group root")));
}

}  // namespace
}  // namespace orbwatch::hal
