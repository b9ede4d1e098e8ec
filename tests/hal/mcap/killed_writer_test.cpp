// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <random>

#include "hal/mcap/completion.h"
#include "hal/mcap/reader.h"
#include "hal/mcap/writer.h"
#include "tests/hal/mcap/recording.h"
#include "tests/support/require.h"
#include "tests/support/share.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::hal::mcap {
namespace {

constexpr std::uint16_t kChannels = 4;
constexpr std::size_t kMost = 20'000;

/// Writes sets of `seed` until it is killed, and a byte to `flushed` after each.
[[noreturn]] void record(const std::filesystem::path& path, unsigned seed, int flushed) {
  std::mt19937 random(seed);
  auto writer = Writer::create(path);
  if (!writer) ::_exit(1);
  tests::define_channels(*writer);
  for (std::uint32_t number = 0;; ++number) {
    for (const auto& message : tests::random_set(random, number, kChannels, kMost)) {
      if (!writer->write(message.head, message.data)) ::_exit(2);
    }
    if (!writer->flush() || ::write(flushed, "x", 1) != 1) ::_exit(3);
  }
}

/// Reads up to `most` bytes; fewer at the end of the pipe.
std::size_t read_up_to(int pipe, std::size_t most) {
  std::size_t count = 0;
  for (char byte = 0; count < most && ::read(pipe, &byte, 1) == 1;) ++count;
  return count;
}

/// Kills a writer after it has flushed `sets` sets; returns the number of sets that it had flushed.
std::size_t record_and_kill(const std::filesystem::path& path, unsigned seed, std::size_t sets) {
  std::array<int, 2> ends{};
  tests::require(::pipe(ends.data()) == 0);
  const FileDescriptor read_end(ends[0]);
  const pid_t child = ::fork();
  if (child == 0) record(path, seed, ends[1]);
  ::close(ends[1]);
  tests::require(child > 0);
  std::size_t flushed = read_up_to(read_end.get(), sets);
  ::kill(child, SIGKILL);
  int status = 0;
  tests::require(::waitpid(child, &status, 0) == child);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself: " << status;
  return flushed + read_up_to(read_end.get(), SIZE_MAX);
}

/// All sets in the file are those of `seed`, and at least `flushed` are there.
std::size_t expect_sets(const std::filesystem::path& path, unsigned seed, std::size_t flushed) {
  Reader reader = tests::opened(path);
  const auto sets = tests::sets_of(reader);
  EXPECT_GE(sets.size(), flushed);
  std::mt19937 random(seed);
  for (std::uint32_t number = 0; number < sets.size(); ++number) {
    EXPECT_EQ(sets[number], tests::random_set(random, number, kChannels, kMost));
  }
  return sets.size();
}

TEST(McapWriter, KilledAnywhereKeepsEveryFlushedSet) {
  std::mt19937 random(1);
  const int count = tests::share_of(1000);
  for (int k = 0; k < count && !testing::Test::HasFailure(); ++k) {
    const auto seed = static_cast<unsigned>(k);
    SCOPED_TRACE(seed);
    const tests::TemporaryFolder folder;
    const auto path = folder / "a.mcap";
    const std::size_t flushed = record_and_kill(path, seed, 1 + tests::up_to(random, 30));
    const std::size_t read = expect_sets(path, seed, flushed);
    const auto completion = complete(path);
    ASSERT_TRUE(completion) << completion.error().message;
    EXPECT_FALSE(completion->was_finished);
    EXPECT_EQ(expect_sets(path, seed, read), read);
    EXPECT_TRUE(complete(path)->was_finished);
  }
}

}  // namespace
}  // namespace orbwatch::hal::mcap
