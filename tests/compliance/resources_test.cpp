// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <string>
#include <vector>

#include "tests/compliance/compliance.h"
#include "tests/support/comes_true.h"

/// A camera releases its resources.
namespace orbwatch::tests {
namespace {

/// Open files and threads of this process.
struct Held {
  std::vector<std::string> files;
  std::size_t threads = 0;
};

Held held() {
  Held now;
  using Entries = std::filesystem::directory_iterator;
  for (const auto& file : Entries("/proc/self/fd")) {
    std::error_code closed_meanwhile;
    now.files.push_back(std::filesystem::read_symlink(file, closed_meanwhile).string());
  }
  const Entries threads("/proc/self/task");
  now.threads = static_cast<std::size_t>(std::distance(begin(threads), end(threads)));
  return now;
}

/// Waits: threads of libraries may close their files a moment later, and the kernel still lists a
/// thread for a moment after it was joined.
void expect_no_more_than(const Held& before) {
  const bool is_released = comes_true([&before] {
    const Held now = held();
    return now.files.size() <= before.files.size() && now.threads <= before.threads;
  });
  const Held now = held();
  EXPECT_TRUE(is_released) << now.threads << " threads, before " << before.threads << "; files "
                           << testing::PrintToString(now.files) << ", before "
                           << testing::PrintToString(before.files);
}

/// Cycles after which libraries hold what they keep after their first use, and threads that they
/// started with the camera have opened their files.
constexpr int kFirstCycles = 5;
constexpr int kCycles = 20;

TEST_F(Compliance, TwentyStreamsLeaveNoFileAndNoThread) {
  Held before;
  for (int cycle = 1; cycle <= kCycles; ++cycle) {
    ASSERT_NO_FATAL_FAILURE(stream(1));
    if (cycle % 5 == 0) {
      ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
    }
    if (cycle == kFirstCycles) before = held();
  }
  expect_no_more_than(before);
}

/// Without a camera when resources are counted: a thread of a new camera may not have opened its
/// files yet.
TEST_F(Compliance, TwentyCamerasLeaveNoFileAndNoThread) {
  Held before;
  for (int cycle = 1; cycle <= kCycles; ++cycle) {
    camera.reset();
    if (cycle == kFirstCycles) before = held();
    camera = subject.make();
    ASSERT_NO_FATAL_FAILURE(configure(*camera, subject.request(), format));
    if (cycle % 10 == 1) {
      ASSERT_NO_FATAL_FAILURE(stream(1));
    }
  }
  camera.reset();
  expect_no_more_than(before);
}

}  // namespace
}  // namespace orbwatch::tests
