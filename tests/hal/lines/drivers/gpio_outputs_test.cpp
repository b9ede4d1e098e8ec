// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "hal/lines/line_thread.h"
#include "hal/lines/pulse_output.h"
#include "hal/lines/watchdog_output.h"
#include "tests/hal/lines/drivers/simulated_chip.h"

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;

class GpioOutputs : public SimulatedChip {
 protected:
  std::unique_ptr<DigitalOutput> open(unsigned line, bool active_low = false) {
    auto output = lines.open_output(
        {.address = {.chip = "orbwatch", .offset = line}, .active_low = active_low});
    EXPECT_TRUE(output) << output.error().message;
    return std::move(*output);
  }

  /// True if the wire reaches the level within the time that emulation needs.
  static bool becomes(unsigned line, bool high) {
    return comes_true([&] { return level(line) == high; });
  }

  /// Starts a process that drives the wire high, and kills it while it does.
  void kill_while_high(unsigned line) {
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      const auto output = open(line);
      const char done = output->set(true) ? 1 : 0;
      if (::write(pipe[1], &done, 1) == 1) ::pause();
      ::_exit(1);
    }
    ::close(pipe[1]);
    char done = 0;
    EXPECT_EQ(::read(pipe[0], &done, 1), 1);
    EXPECT_EQ(done, 1);
    ::close(pipe[0]);
    EXPECT_TRUE(level(line)) << "it drives";
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status));
  }
};

TEST_F(GpioOutputs, DriveTheWireAndLeaveItInactive) {
  auto output = open(kOutput);
  EXPECT_FALSE(level(kOutput));
  ASSERT_TRUE(output->set(true));
  EXPECT_TRUE(level(kOutput));
  ASSERT_TRUE(output->set(false));
  EXPECT_FALSE(level(kOutput));
  ASSERT_TRUE(output->set(true));
  output.reset();
  EXPECT_FALSE(level(kOutput));
}

TEST_F(GpioOutputs, ActiveLowIsHighAtRest) {
  const auto output = open(kOutput, true);
  EXPECT_TRUE(level(kOutput));
  ASSERT_TRUE(output->set(true));
  EXPECT_FALSE(level(kOutput));
}

TEST_F(GpioOutputs, AKilledProcessLeavesTheWireToItsResistor) {
  kill_while_high(kOutput);
  EXPECT_TRUE(becomes(kOutput, false)) << "pulled down";
  pull(kOutput, true);
  kill_while_high(kOutput);
  EXPECT_TRUE(becomes(kOutput, true)) << "pulled up: no safe state without the right resistor";
  EXPECT_TRUE(lines.open_output({.address = {.name = "TRIGGER_OUT"}})) << "free again";
}

TEST_F(GpioOutputs, APulseIsOneForEachCommand) {
  LineThread thread;
  PulseOutput::Outputs outputs;
  outputs.push_back(open(kOutput));
  PulseOutput pulse({.width = milliseconds(300)}, std::move(outputs), [&thread] { thread.wake(); });
  thread.add(pulse);
  ASSERT_TRUE(thread.start());
  for (std::uint64_t i = 1; i <= 5; ++i) {
    ASSERT_TRUE(pulse.fire(Clock::now()));
    EXPECT_TRUE(becomes(kOutput, true));
    EXPECT_TRUE(becomes(kOutput, false));
    EXPECT_TRUE(comes_true([&] { return pulse.due() == TimePoint::max(); }));
    EXPECT_EQ(pulse.counts().pulses, i);
  }
  thread.stop();
  EXPECT_EQ(pulse.counts().missed, 0U);
  EXPECT_EQ(pulse.counts().failed, 0U);
}

TEST_F(GpioOutputs, ATrainPulsesOnEveryLine) {
  LineThread thread;
  PulseOutput::Outputs outputs;
  outputs.push_back(open(kOutput));
  outputs.push_back(open(kUnnamed, true));
  PulseOutput pulses({.period = milliseconds(600), .width = milliseconds(300)}, std::move(outputs),
                     [&thread] { thread.wake(); });
  thread.add(pulses);
  ASSERT_TRUE(thread.start());
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(comes_true([] { return level(kOutput) && !level(kUnnamed); }));
    EXPECT_TRUE(comes_true([] { return !level(kOutput) && level(kUnnamed); }));
  }
  thread.stop();
  EXPECT_GE(pulses.counts().pulses, 3U);
  EXPECT_EQ(pulses.counts().failed, 0U);
}

TEST_F(GpioOutputs, ProcessOkTogglesAndFallsWithoutReports) {
  LineThread thread;
  WatchdogOutput ok({.timeout = milliseconds(1500), .half_period = milliseconds(200)},
                    open(kOutput), [&thread] { thread.wake(); });
  thread.add(ok);
  ASSERT_TRUE(thread.start());
  ok.report(true, Clock::now());
  EXPECT_TRUE(becomes(kOutput, true));
  EXPECT_TRUE(becomes(kOutput, false));
  EXPECT_TRUE(comes_true([&] { return ok.due() == TimePoint::max(); })) << "it has given up";
  EXPECT_FALSE(level(kOutput));
  thread.stop();
}

}  // namespace
}  // namespace orbwatch::hal
