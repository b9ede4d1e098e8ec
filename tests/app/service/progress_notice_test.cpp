// SPDX-License-Identifier: Apache-2.0
#include "app/service/progress_notice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "app/service/service_manager.h"
#include "tests/support/notify_socket.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::Not;
using tests::NotifySocket;

constexpr auto kPatience = std::chrono::minutes(1);

TEST(ServiceManager, IsSeenByItsSocket) {
  EXPECT_FALSE(has_service_manager());
  EXPECT_EQ(watchdog_period(), milliseconds(0));
  const tests::TemporaryFolder folder;
  const NotifySocket manager(folder / "notify", milliseconds(700));
  EXPECT_TRUE(has_service_manager());
  EXPECT_EQ(watchdog_period(), milliseconds(700));
}

TEST(ServiceManager, MayNotReadWithoutHarm) {
  const tests::TemporaryFolder folder;
  { const NotifySocket gone(folder / "notify", milliseconds(0)); }
  ::setenv("NOTIFY_SOCKET", (folder / "notify").c_str(), 1);
  notify("READY=1");
  ::unsetenv("NOTIFY_SOCKET");
}

TEST(ProgressNotice, TheFirstStatusIsReadinessAndTheNextFeedsTheWatchdog) {
  const tests::TemporaryFolder folder;
  // There is no pause between two messages: every status feeds.
  const NotifySocket manager(folder / "notify", milliseconds(0));
  ::setenv("WATCHDOG_USEC", "1", 1);
  ProgressNotice notice("the last good configuration runs");
  ASSERT_TRUE(notice.start());
  EXPECT_FALSE(manager.next(milliseconds(50))) << "the pipeline has not passed yet";

  Status status;
  notice.accept(status);
  const auto ready = manager.next(kPatience);
  ASSERT_TRUE(ready);
  EXPECT_THAT(*ready, HasSubstr("READY=1\n"));
  EXPECT_THAT(*ready, HasSubstr("STATUS=starting: no frame set yet; the last good configuration"));
  EXPECT_THAT(*ready, HasSubstr("WATCHDOG_USEC=1\n")) << "as before a restart";

  notice.accept(status);
  EXPECT_EQ(manager.next(kPatience), "WATCHDOG=1");
  status.state = SystemState::Running;
  notice.accept(status);
  const auto running = manager.next(kPatience);
  ASSERT_TRUE(running);
  EXPECT_THAT(*running, HasSubstr("WATCHDOG=1\nSTATUS=running"));
  EXPECT_FALSE(manager.next(milliseconds(50))) << "without progress nothing feeds it";
}

TEST(ProgressNotice, FeedsNothingWhileNobodySupervises) {
  const tests::TemporaryFolder folder;
  const NotifySocket manager(folder / "notify", milliseconds(0));
  ::setenv("WATCHDOG_USEC", "1", 1);
  std::atomic<bool> is_supervised = true;
  ProgressNotice notice("", [&] { return is_supervised.load(); });
  ASSERT_TRUE(notice.start());
  Status status;
  notice.accept(status);
  ASSERT_TRUE(manager.next(kPatience));
  is_supervised = false;
  status.state = SystemState::Running;
  notice.accept(status);
  EXPECT_FALSE(manager.next(milliseconds(50)));
  is_supervised = true;
  notice.accept(status);
  EXPECT_THAT(manager.next(kPatience).value_or(""), HasSubstr("WATCHDOG=1\nSTATUS=running"));
}

TEST(ProgressNotice, WithoutAWatchdogOnlyChangesAreSent) {
  const tests::TemporaryFolder folder;
  const NotifySocket manager(folder / "notify", milliseconds(0));
  ProgressNotice notice;
  ASSERT_TRUE(notice.start());
  Status status;
  notice.accept(status);
  const auto ready = manager.next(kPatience);
  ASSERT_TRUE(ready);
  EXPECT_THAT(*ready, Not(HasSubstr("WATCHDOG_USEC")));
  notice.accept(status);
  status.state = SystemState::Fault;
  notice.accept(status);
  const auto fault = manager.next(kPatience);
  ASSERT_TRUE(fault);
  EXPECT_THAT(*fault, HasSubstr("STATUS=fault"));
}

TEST(ProgressNotice, SaysThatAnInterfaceHasAFault) {
  const tests::TemporaryFolder folder;
  const NotifySocket manager(folder / "notify", milliseconds(0));
  ProgressNotice notice;
  ASSERT_TRUE(notice.start());
  Status status;
  status.state = SystemState::Running;
  notice.accept(status);
  ASSERT_TRUE(manager.next(kPatience));
  status.interface_faults = 1;
  notice.accept(status);
  EXPECT_THAT(manager.next(kPatience).value_or(""), HasSubstr("interface cannot be opened"));
}

}  // namespace
}  // namespace orbwatch::app
