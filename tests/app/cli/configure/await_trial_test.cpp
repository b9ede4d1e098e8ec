// SPDX-License-Identifier: Apache-2.0
#include "app/cli/configure/await_trial.h"

#include <gmock/gmock.h>

#include <thread>

#include "app/files/runtime/trial.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::cli {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;

constexpr TrialPatience kLong{milliseconds(60'000), milliseconds(60'000)};

/// Fixture with a requested trial; the test is the daemon.
class AwaitTrial : public testing::Test {
 protected:
  AwaitTrial() {
    EXPECT_TRUE(files::report_trial(folder.path(), "of a request before"));
    EXPECT_TRUE(files::request_trial(folder.path(), {"/etc/site.toml", {}, 60}));
  }

  /// Returns the refusal; empty: the trial runs.
  std::string refusal(const TrialPatience& patience) const {
    const auto awaited = await_trial(folder.path(), "orbwatch@press", patience);
    return awaited ? "" : awaited.error().message;
  }

  const orbwatch::tests::TemporaryFolder folder;
};

TEST_F(AwaitTrial, EndsWhenItRuns) {
  std::thread daemon([&] {
    EXPECT_TRUE(files::take_trial(folder.path()));
    EXPECT_TRUE(files::report_trial(folder.path(), {}));
  });
  EXPECT_EQ(refusal(kLong), "");
  daemon.join();
}

TEST_F(AwaitTrial, SaysWhyItDoesNotRun) {
  std::thread daemon([&] {
    EXPECT_TRUE(files::take_trial(folder.path()));
    EXPECT_TRUE(files::report_trial(folder.path(), "site.toml:1: is wrong"));
    EXPECT_TRUE(files::end_trial(folder.path()));
  });
  EXPECT_THAT(refusal(kLong), HasSubstr("site.toml:1: is wrong"));
  daemon.join();
}

TEST_F(AwaitTrial, SaysThatItEnded) {
  EXPECT_TRUE(files::take_trial(folder.path()));
  EXPECT_TRUE(files::end_trial(folder.path())) << "the process ended, the next one found it";
  EXPECT_THAT(refusal(kLong), HasSubstr("ended before it ran"));
}

TEST_F(AwaitTrial, WithdrawsWhatNobodyTakes) {
  EXPECT_THAT(refusal({milliseconds(1), milliseconds(1)}),
              AllOf(HasSubstr("no orbwatchd has taken it up"), HasSubstr("orbwatch@press")));
  EXPECT_FALSE(files::is_trial_requested(folder.path()));
}

TEST_F(AwaitTrial, SaysThatADaemonIsSilent) {
  EXPECT_TRUE(files::take_trial(folder.path()));
  EXPECT_THAT(refusal({milliseconds(1), milliseconds(1)}), HasSubstr("does not say that it runs"));
}

}  // namespace
}  // namespace orbwatch::app::cli
