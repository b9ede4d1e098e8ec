// SPDX-License-Identifier: Apache-2.0
#include "app/service/child_program.h"

#include <gmock/gmock.h>
#include <signal.h>

#include <thread>

namespace orbwatch::app {
namespace {

using testing::HasSubstr;

Result<ChildEnd> shell(const std::string& script, const std::string& secret = "") {
  return run_child({.program = "/bin/sh",
                    .arguments = {"-c", script},
                    .environment = {"PATH=/usr/bin:/bin", "COLOUR=blue"},
                    .secret = secret,
                    .time = std::chrono::minutes(1)});
}

TEST(ChildProgram, HasStatusAndBothOutputs) {
  const auto end = shell("echo $COLOUR; echo wrong >&2; exit 3");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(end->status, 3);
  EXPECT_EQ(end->output, "blue\n");
  EXPECT_EQ(end->errors, "wrong\n");
}

TEST(ChildProgram, ReadsItsSecretWithoutShowingIt) {
  const auto end =
      shell("cat " + std::string(kChildSecret) + "; env; tr '\\0' ' ' </proc/self/cmdline", "hush");
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(end->output.find("hush"), 0U);
  EXPECT_EQ(end->output.find("hush", 1), std::string::npos) << end->output;
  EXPECT_NE(shell("cat " + std::string(kChildSecret))->status, 0) << "there is none";
}

/// The daemon blocks its signals in all threads.
TEST(ChildProgram, IsEndedBySignalsThatThisThreadBlocks) {
  sigset_t blocked, before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, &before);
  const auto end = shell("kill -TERM $$; echo lives");
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_FALSE(end);
}

TEST(ChildProgram, IsCancelled) {
  const hal::EventFd cancelled;
  std::thread other([&] { cancelled.signal(); });
  const auto end = run_child({.program = "/bin/sh",
                              .arguments = {"-c", "sleep 1000"},
                              .environment = {"PATH=/usr/bin:/bin"},
                              .time = std::chrono::hours(1),
                              .cancelled = &cancelled});
  other.join();
  EXPECT_FALSE(end);
}

TEST(ChildProgram, ThatIsAbsentIsNamed) {
  const auto end = run_child({.program = "/no/such/program"});
  ASSERT_FALSE(end);
  EXPECT_THAT(end.error().message, HasSubstr("/no/such/program"));
}

TEST(ChildProgram, HasTheEnvironmentWithoutSomeNames) {
  ::setenv("ORBWATCH_TEST_A", "1", 1);
  ::setenv("ORBWATCH_TEST_B", "2", 1);
  const auto entries = environment_without({"ORBWATCH_TEST_A"});
  ::unsetenv("ORBWATCH_TEST_A");
  ::unsetenv("ORBWATCH_TEST_B");
  EXPECT_THAT(entries, testing::Contains("ORBWATCH_TEST_B=2"));
  EXPECT_THAT(entries, testing::Not(testing::Contains("ORBWATCH_TEST_A=1")));
}

}  // namespace
}  // namespace orbwatch::app
