// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "tests/compliance/compliance.h"
#include "tests/support/comes_true.h"

/// A camera releases its resources.
namespace orbwatch::tests {
namespace {

std::size_t entries(const char* folder) {
  const std::filesystem::directory_iterator first(folder);
  return static_cast<std::size_t>(std::distance(begin(first), end(first)));
}

std::size_t open_files() { return entries("/proc/self/fd"); }

/// The kernel still lists a thread for a moment after it was joined.
std::size_t threads() { return entries("/proc/self/task"); }

TEST_F(Compliance, TwentyStreamsLeaveNoFileAndNoThread) {
  constexpr int kCycles = 20;
  std::size_t files_before = 0, threads_before = 0;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    ASSERT_NO_FATAL_FAILURE(stream(1));
    if (cycle % 5 == 4) {
      ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
    }
    // Libraries may keep resources after their first use.
    if (cycle == 1) files_before = open_files(), threads_before = threads();
  }
  // Threads of libraries may close their files a moment later.
  EXPECT_TRUE(comes_true([&] { return open_files() <= files_before; }))
      << open_files() << ", before " << files_before;
  EXPECT_TRUE(comes_true([&] { return threads() <= threads_before; }))
      << threads() << ", before " << threads_before;
}

TEST_F(Compliance, TwentyCamerasLeaveNoFileAndNoThread) {
  constexpr int kCycles = 20;
  std::size_t files_before = 0, threads_before = 0;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    camera.reset();
    camera = subject.make();
    ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
    if (cycle % 10 == 0) {
      ASSERT_NO_FATAL_FAILURE(stream(1));
    }
    if (cycle == 1) files_before = open_files(), threads_before = threads();
  }
  // Threads of libraries may close their files a moment later.
  EXPECT_TRUE(comes_true([&] { return open_files() <= files_before; }))
      << open_files() << ", before " << files_before;
  EXPECT_TRUE(comes_true([&] { return threads() <= threads_before; }))
      << threads() << ", before " << threads_before;
}

}  // namespace
}  // namespace orbwatch::tests
