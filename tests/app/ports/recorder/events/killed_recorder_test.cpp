// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/recording_folder.h"
#include "hal/thread/file_descriptor.h"
#include "tests/app/ports/recorder/events/painted_event.h"
#include "tests/support/require.h"
#include "tests/support/share.h"
#include "tests/support/temporary_folder.h"

/// SIGKILL at any moment of recording: the next start keeps every frame set that was on the disk.
namespace orbwatch::app::recorder {
namespace {

namespace fs = std::filesystem;
using orbwatch::tests::require;
using std::chrono::milliseconds;
using tests::RecordedMachine;

constexpr std::uint64_t kFirstTrigger = 8, kNextTrigger = 20;  // and each so many frame sets

bool is_trigger(std::uint64_t set) { return set % kNextTrigger == kFirstTrigger; }

RecorderSettings settings_in(const fs::path& folder) {
  EventSettings events;
  events.ring_mib = 1;
  events.before = milliseconds(50);
  events.after = milliseconds(80);
  events.longest = milliseconds(300);
  return {.folder = folder, .events = events};
}

/// Records until it is killed; a byte in `on_disk` for each frame set.
[[noreturn]] void record(const fs::path& folder, int on_disk) {
  RecordedMachine machine(settings_in(folder));
  for (std::uint64_t set = 1;; ++set) {
    machine.pass(set, is_trigger(set));
    for (Result<bool> is_more = true; is_more && *is_more;) {
      is_more = machine.record();
      if (!is_more) ::_exit(1);
    }
    if (!machine.recorder().flush() || ::write(on_disk, "x", 1) != 1) ::_exit(2);
  }
}

/// Reads up to `most` bytes; fewer at the end of the pipe.
std::uint64_t read_up_to(int pipe, std::uint64_t most) {
  std::uint64_t count = 0;
  for (char byte = 0; count < most && ::read(pipe, &byte, 1) == 1;) ++count;
  return count;
}

/// Kills a recorder at a random moment; returns the number of frame sets that were on the disk.
std::uint64_t record_and_kill(const fs::path& folder, std::mt19937& random) {
  const auto last = std::uniform_int_distribution<std::uint64_t>(1, 40)(random);
  const auto spin = std::uniform_int_distribution<unsigned>(0, 2'000'000)(random);
  std::array<int, 2> ends{};
  require(::pipe(ends.data()) == 0);
  const hal::FileDescriptor read_end(ends[0]);
  const pid_t child = ::fork();
  if (child == 0) record(folder, ends[1]);
  ::close(ends[1]);
  require(child > 0);
  const std::uint64_t sets = read_up_to(read_end.get(), last);
  random.discard(spin);  // takes up to some milliseconds
  ::kill(child, SIGKILL);
  int status = 0;
  require(::waitpid(child, &status, 0) == child);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the recorder ended by itself: " << status;
  return sets + read_up_to(read_end.get(), UINT64_MAX);
}

/// The event of this trigger has all its frame sets that were on the disk, and at most the one
/// behind them. If that one is the trigger, the sets before it need not be in the event.
void expect_event(const fs::path& folder, std::uint64_t trigger, std::uint64_t on_disk) {
  const RecorderSettings site = settings_in({});
  auto topics = tests::read_recording(folder / kEventFile);
  tests::expect_painted(topics);
  const std::uint64_t first = RecordedMachine::first_of(trigger, site.events->before);
  const std::uint64_t last = RecordedMachine::last_of(trigger, site.events->after);
  const auto thermal = tests::sequences_of(topics[tests::kThermal]);
  const auto colour = tests::sequences_of(topics[tests::kColour]);
  const auto states = tests::frame_sets_of(topics[tests::kStates]);
  const std::uint64_t end = trigger <= on_disk ? std::min(last, on_disk) : 0;
  for (std::uint64_t set = first; set <= end; ++set) {
    EXPECT_EQ(std::ranges::count(thermal, set), 1) << set;
    EXPECT_EQ(std::ranges::count(colour, set), set % 3 == 0 ? 0 : 1) << set;
    EXPECT_EQ(std::ranges::count(states, set), 1) << set;
  }
  for (const auto& numbers : {thermal, colour, states}) {
    for (const std::uint64_t set : numbers) {
      EXPECT_TRUE(set >= first && set <= std::min(last, on_disk + 1)) << set;
    }
  }
}

TEST(EventRecorder, KilledAnywhereKeepsEveryFrameSetThatWasOnTheDisk) {
  std::mt19937 random(36);
  int interrupted = 0;
  for (int k = tests::share_of(1000); k > 0 && !testing::Test::HasFailure(); --k) {
    SCOPED_TRACE(k);
    const orbwatch::tests::TemporaryFolder folder;
    const std::uint64_t on_disk = record_and_kill(folder.path(), random);
    RecordingFolder next_start(settings_in(folder.path()));
    ASSERT_TRUE(next_start.prepare());
    const auto events = EventFolder(folder.path()).list();
    ASSERT_TRUE(events) << events.error().message;
    std::map<std::uint64_t, fs::path> by_trigger;
    for (const StoredEvent& event : *events) {
      EXPECT_TRUE(event.is_finished) << event.folder;
      const auto summary = read_summary(event.folder);
      ASSERT_TRUE(summary) << summary.error().message;
      by_trigger[summary->frame_set] = event.folder;
      interrupted += summary->is_interrupted ? 1 : 0;
    }
    for (std::uint64_t set = 1; set <= on_disk; ++set) {
      EXPECT_EQ(by_trigger.contains(set), is_trigger(set)) << set;
    }
    for (const auto& [trigger, event] : by_trigger) expect_event(event, trigger, on_disk);
  }
  EXPECT_GT(interrupted, 0) << "no kill hit a recording";
}

}  // namespace
}  // namespace orbwatch::app::recorder
