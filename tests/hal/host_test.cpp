// SPDX-License-Identifier: Apache-2.0
#include "hal/host.h"

#include <gtest/gtest.h>
#include <sys/utsname.h>

namespace orbwatch::hal {
namespace {

TEST(Host, HasTheNameThatTheKernelSays) {
  utsname kernel{};
  ASSERT_EQ(::uname(&kernel), 0);
  EXPECT_EQ(host_name(), kernel.nodename);
}

TEST(Host, KnowsTheAddressesThatStandForAllNetworks) {
  for (const char* address : {"0.0.0.0", "::"}) EXPECT_TRUE(is_unspecified(address)) << address;
  for (const char* address : {"127.0.0.1", "::1", "10.0.0.0", ""}) {
    EXPECT_FALSE(is_unspecified(address)) << address;
  }
}

}  // namespace
}  // namespace orbwatch::hal
