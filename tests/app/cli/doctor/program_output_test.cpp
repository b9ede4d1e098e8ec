// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/program_output.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "hal/thread/file_descriptor.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::cli::doctor {
namespace {

using namespace std::chrono_literals;

std::optional<std::string> shell(const std::string& script, const ProgramLimits& limits = {}) {
  return program_output("/bin/sh", {"-c", script}, limits);
}

TEST(ProgramOutput, IsWhatItPrints) {
  EXPECT_EQ(shell("echo one; echo two >&2"), "one\n");
  EXPECT_EQ(shell("exit 0"), "");
  EXPECT_EQ(shell("cat"), "") << "nothing to read from";
  EXPECT_EQ(shell("echo $LC_ALL"), "C\n");
  EXPECT_EQ(shell("head -c 100000 /dev/zero")->size(), 100000U);
}

TEST(ProgramOutput, OfWhatFailsIsNone) {
  EXPECT_FALSE(shell("echo half; exit 3"));
  EXPECT_FALSE(shell("kill -9 $$"));
  EXPECT_FALSE(program_output("/no/such/program", {}));
  EXPECT_FALSE(program_output("/", {}));
}

TEST(ProgramOutput, TooMuchIsNone) {
  EXPECT_FALSE(shell("cat /dev/zero", {.bytes = 10000}));
  EXPECT_EQ(shell("printf 12345", {.bytes = 5}), "12345");
  EXPECT_FALSE(shell("printf 123456", {.bytes = 5}));
}

/// Waits for the end of a process that is not a child; false: it still runs.
bool ends(pid_t process) {
  const hal::FileDescriptor descriptor(static_cast<int>(::syscall(SYS_pidfd_open, process, 0)));
  if (!descriptor.is_open()) return errno == ESRCH;
  pollfd end{descriptor.get(), POLLIN, 0};
  return ::poll(&end, 1, 60000) == 1;
}

/// The script's wait is much longer than the test.
TEST(ProgramOutput, TooLateIsNoneAndKilledWithWhatItStarted) {
  const tests::TemporaryFolder folder;
  for (const std::string closing : {"", "exec >&-; "}) {
    const auto pid_file = (folder / "pid").string();
    EXPECT_FALSE(shell(closing + "sleep 1000 & echo $! >" + pid_file + "; wait", {.time = 2s}));
    pid_t started = 0;
    std::ifstream(pid_file) >> started;
    ASSERT_GT(started, 0);
    EXPECT_TRUE(ends(started));
    std::filesystem::remove(pid_file);
  }
}

}  // namespace
}  // namespace orbwatch::app::cli::doctor
