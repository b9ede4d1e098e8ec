#include "app/ports/web/access/login_limits.h"

#include <gtest/gtest.h>

#include "app/ports/web/http/address.h"

namespace orbwatch::app::web::tests {
namespace {

using std::chrono::seconds;

constexpr Utc kStart{seconds(1'800'000'000)};

TEST(LoginLimits, WaitDoublesUpToALimitForEach) {
  LoginLimits limits;
  Utc now = kStart;
  for (int i = 0; i < LoginLimits::kFree - 1; ++i) limits.failed("admin", "10.0.0.1", now);
  EXPECT_EQ(limits.wait("admin", "10.0.0.1", now), seconds(0));
  for (const int expected : {1, 2, 4, 8, 16, 32, 64, 128}) {
    limits.failed("admin", "10.0.0.1", now);
    EXPECT_EQ(limits.wait("other", "10.0.0.1", now), seconds(expected));
    EXPECT_EQ(limits.wait("admin", "10.0.0.2", now),
              std::min(seconds(expected), LoginLimits::kLongestForName));
    EXPECT_EQ(limits.wait("other", "10.0.0.2", now), seconds(0));
    now += seconds(expected);
    EXPECT_EQ(limits.wait("admin", "10.0.0.1", now), seconds(0));
  }
  for (int i = 0; i < 100; ++i) limits.failed("admin", "10.0.0.1", now);
  EXPECT_EQ(limits.wait("other", "10.0.0.1", now), LoginLimits::kLongestForAddress);
}

TEST(LoginLimits, AnHourForgets) {
  LoginLimits limits;
  for (int i = 0; i < 100; ++i) limits.failed("admin", "10.0.0.1", kStart);
  limits.failed("admin", "10.0.0.1", kStart + LoginLimits::kForgetAfter);
  EXPECT_EQ(limits.wait("admin", "10.0.0.1", kStart + LoginLimits::kForgetAfter), seconds(0));
}

/// A board without a battery begins in the past.
TEST(LoginLimits, AClockThatIsSetLocksNobodyOut) {
  LoginLimits limits;
  for (int i = 0; i < 100; ++i) limits.failed("admin", "10.0.0.1", kStart);
  EXPECT_EQ(limits.wait("x", "10.0.0.1", kStart - seconds(600)), LoginLimits::kLongestForAddress);
  EXPECT_EQ(limits.wait("x", "10.0.0.1", kStart - seconds(86400)), seconds(0));
}

TEST(LoginLimits, SuccessForgetsTheNameOnly) {
  LoginLimits limits;
  for (int i = 0; i < 10; ++i) limits.failed("admin", "10.0.0.1", kStart);
  limits.succeeded("admin");
  EXPECT_EQ(limits.wait("admin", "10.0.0.2", kStart), seconds(0));
  EXPECT_GT(limits.wait("admin", "10.0.0.1", kStart), seconds(0));
}

TEST(LoginLimits, AFloodOfNamesTakesNoMoreMemory) {
  LoginLimits limits;
  for (int i = 0; i < 2000; ++i) {
    limits.failed("name" + std::to_string(i), "10.0.0.1", kStart + seconds(i));
  }
  EXPECT_EQ(limits.names().size(), LoginLimits::kMostKept);
  EXPECT_EQ(limits.addresses().size(), 1U);
  EXPECT_EQ(limits.wait("x", "10.0.0.1", kStart + seconds(2000)) > seconds(0), true);
}

TEST(LoginLimits, ANetworkOfIpv6IsOneAddress) {
  EXPECT_EQ(address_key("10.0.0.7"), "10.0.0.7");
  EXPECT_EQ(address_key("fd00:1:2:3:4:5:6:7"), address_key("fd00:1:2:3::9"));
  EXPECT_NE(address_key("fd00:1:2:3::9"), address_key("fd00:1:2:4::9"));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
