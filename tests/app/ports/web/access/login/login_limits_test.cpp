// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/login/login_limits.h"

#include <gtest/gtest.h>

#include "app/ports/web/http/address.h"

namespace orbwatch::app::web::tests {
namespace {

using std::chrono::seconds;
using LoginAttempt = LoginLimits::Attempt;

constexpr Utc kStart{seconds(1'800'000'000)};
const LoginAttempt kAdminThere{"admin", "10.0.0.1"};
const LoginAttempt kOtherName{"other", "10.0.0.1"};
const LoginAttempt kOtherAddress{"admin", "10.0.0.2"};

void fail_often(LoginLimits& limits, const LoginAttempt& attempt, int times, Utc now = kStart) {
  for (int i = 0; i < times; ++i) limits.failed(attempt, now);
}

/// Guesses from 16 addresses, each as often as permitted.
Utc guess_from_many(LoginLimits& limits, const std::string& name, Utc now, seconds duration) {
  for (const Utc end = now + duration; now < end; now += seconds(1)) {
    for (int i = 0; i < 16; ++i) {
      const LoginAttempt guess{name, "10.0.1." + std::to_string(i)};
      if (limits.wait(guess, now).count() == 0) limits.failed(guess, now);
    }
  }
  return now;
}

TEST(LoginLimits, WaitDoublesUpToALimitForEach) {
  LoginLimits limits;
  Utc now = kStart;
  fail_often(limits, kAdminThere, LoginLimits::kFree - 1, now);
  EXPECT_EQ(limits.wait(kAdminThere, now), seconds(0));
  for (const int expected : {1, 2, 4, 8, 16, 32, 64, 128}) {
    limits.failed(kAdminThere, now);
    EXPECT_EQ(limits.wait(kOtherName, now), seconds(expected));
    EXPECT_EQ(limits.wait(kOtherAddress, now),
              std::min(seconds(expected), LoginLimits::kLongestForName));
    EXPECT_EQ(limits.wait({"other", "10.0.0.2"}, now), seconds(0));
    now += seconds(expected);
    EXPECT_EQ(limits.wait(kAdminThere, now), seconds(0));
  }
  fail_often(limits, kAdminThere, 100, now);
  EXPECT_EQ(limits.wait(kOtherName, now), LoginLimits::kLongestForAddress);
}

TEST(LoginLimits, AnHourForgets) {
  LoginLimits limits;
  limits.succeeded(kOtherAddress);
  for (const LoginAttempt& attempt : {kAdminThere, kOtherAddress}) {
    fail_often(limits, attempt, 100);
    limits.failed(attempt, kStart + LoginLimits::kForgetAfter);
    EXPECT_EQ(limits.wait(attempt, kStart + LoginLimits::kForgetAfter), seconds(0));
  }
}

/// A board without a battery starts in the past.
TEST(LoginLimits, AClockThatIsSetLocksNobodyOut) {
  LoginLimits limits;
  fail_often(limits, kAdminThere, 100);
  EXPECT_EQ(limits.wait(kAdminThere, kStart - seconds(600)), LoginLimits::kLongestForAddress);
  EXPECT_EQ(limits.wait(kAdminThere, kStart - seconds(86400)), seconds(0));
}

TEST(LoginLimits, ManyAddressesGuessANameNoFasterThanOne) {
  LoginLimits limits;
  Utc now = kStart;
  int guesses = 0;
  for (int i = 0; i < 36000; ++i, now += seconds(1)) {
    const LoginAttempt guess{"admin",
                             "10." + std::to_string(i / 256) + ".0." + std::to_string(i % 256)};
    if (limits.wait(guess, now).count() > 0) continue;
    limits.failed(guess, now);
    ++guesses;
  }
  EXPECT_GT(guesses, 500);
  EXPECT_LE(guesses, 36000 / LoginLimits::kLongestForName.count() + 12);
}

TEST(LoginLimits, GuessesFromElsewhereMakeNobodyWaitWhereTheNameHasLoggedIn) {
  LoginLimits limits;
  limits.succeeded(kAdminThere);
  const Utc now = guess_from_many(limits, "admin", kStart, seconds(600));
  EXPECT_TRUE(limits.is_familiar(kAdminThere));
  EXPECT_EQ(limits.wait(kAdminThere, now), seconds(0));
  EXPECT_GT(limits.wait(kOtherAddress, now - seconds(1)), seconds(0)) << "any other address waits";
  EXPECT_FALSE(limits.is_familiar(kOtherAddress));
}

TEST(LoginLimits, GuessingIsSlowWhereTheNameHasLoggedIn) {
  LoginLimits limits;
  limits.succeeded(kAdminThere);
  fail_often(limits, kOtherName, 100);
  EXPECT_EQ(limits.wait(kAdminThere, kStart), seconds(0)) << "failures of other names there";
  fail_often(limits, kAdminThere, LoginLimits::kFree);
  EXPECT_EQ(limits.wait(kAdminThere, kStart), seconds(1));
  fail_often(limits, kAdminThere, 100);
  EXPECT_EQ(limits.wait(kAdminThere, kStart), LoginLimits::kLongestForName);
  EXPECT_EQ(limits.wait(kOtherAddress, kStart), seconds(0));
}

TEST(LoginLimits, ThisComputerWaitsForItsOwnFailuresOnly) {
  LoginLimits limits;
  const LoginAttempt local{"admin", "127.0.0.1", true};
  const Utc now = guess_from_many(limits, "admin", kStart, seconds(600));
  EXPECT_EQ(limits.wait(local, now), seconds(0));
  fail_often(limits, local, 100, now);
  EXPECT_EQ(limits.wait(local, now), LoginLimits::kLongestForName);
}

TEST(LoginLimits, ACodeIsLimitedByAddressAlone) {
  LoginLimits limits;
  guess_from_many(limits, "", kStart, seconds(60));
  EXPECT_EQ(limits.wait({"", "10.0.0.1"}, kStart + seconds(60)), seconds(0));
  EXPECT_GT(limits.wait({"", "10.0.1.1"}, kStart + seconds(60)), seconds(0));
}

TEST(LoginLimits, SuccessForgivesTheAddressButNoNameThatWasGuessed) {
  LoginLimits limits;
  fail_often(limits, kAdminThere, 10);
  limits.succeeded({"kim", "10.0.0.1"});
  EXPECT_EQ(limits.wait({"lee", "10.0.0.1"}, kStart), seconds(0));
  EXPECT_GT(limits.wait(kAdminThere, kStart), seconds(0));
  EXPECT_GT(limits.wait(kOtherAddress, kStart), seconds(0));
}

TEST(LoginLimits, AnotherPasswordForgivesTheName) {
  LoginLimits limits;
  limits.succeeded(kOtherAddress);
  fail_often(limits, kOtherAddress, 10);
  fail_often(limits, kAdminThere, 10);
  limits.forgive_name("admin");
  EXPECT_EQ(limits.wait(kOtherAddress, kStart), seconds(0));
  EXPECT_EQ(limits.wait({"admin", "10.0.0.3"}, kStart), seconds(0));
  EXPECT_GT(limits.wait(kAdminThere, kStart), seconds(0)) << "the address";
  limits.forgive_addresses();
  EXPECT_EQ(limits.wait(kAdminThere, kStart), seconds(0));
}

TEST(LoginLimits, AFloodOfNamesTakesNoMoreMemoryAndForgivesNobody) {
  LoginLimits limits;
  fail_often(limits, kOtherAddress, 12);
  for (int i = 0; i < 2000; ++i) {
    limits.failed({"name" + std::to_string(i), "10.0.0.1"}, kStart + seconds(i / 100));
  }
  EXPECT_EQ(limits.names().size(), LoginLimits::kMostKept);
  EXPECT_EQ(limits.addresses().size(), 2U);
  EXPECT_GT(limits.wait(kAdminThere, kStart + seconds(20)), seconds(0));
  EXPECT_GT(limits.wait({"admin", "10.0.0.3"}, kStart + seconds(20)), seconds(0));
}

TEST(LoginLimits, AUserHasFewFamiliarAddresses) {
  LoginLimits limits;
  limits.succeeded(kAdminThere);
  for (std::size_t i = 0; i < LoginLimits::kMostFamiliarOfName; ++i) {
    limits.succeeded({"kim", "10.0.1." + std::to_string(i)});
  }
  limits.succeeded({"kim", "10.0.1.0"});  // repeated, therefore the newest
  limits.succeeded({"kim", "10.0.1.99"});
  EXPECT_EQ(limits.familiar().size(), LoginLimits::kMostFamiliarOfName + 1);
  EXPECT_TRUE(limits.is_familiar(kAdminThere));
  EXPECT_TRUE(limits.is_familiar({"kim", "10.0.1.0"}));
  EXPECT_FALSE(limits.is_familiar({"kim", "10.0.1.1"}));
  for (int i = 0; i < 1000; ++i) limits.succeeded({"name" + std::to_string(i), "10.0.0.1"});
  EXPECT_EQ(limits.familiar().size(), LoginLimits::kMostFamiliar);
}

TEST(LoginLimits, ANetworkOfIpv6IsOneAddress) {
  EXPECT_EQ(address_key("10.0.0.7"), "10.0.0.7");
  EXPECT_EQ(address_key("fd00:1:2:3:4:5:6:7"), address_key("fd00:1:2:3::9"));
  EXPECT_NE(address_key("fd00:1:2:3::9"), address_key("fd00:1:2:4::9"));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
