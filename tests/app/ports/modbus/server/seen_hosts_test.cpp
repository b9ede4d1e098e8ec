// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/seen_hosts.h"

#include <gtest/gtest.h>

namespace orbwatch::app::modbus {
namespace {

TEST(SeenHosts, EachIsNewOnceAndOnlySoManyAreKept) {
  SeenHosts hosts;
  for (std::uint8_t n = 0; n < SeenHosts::kMost; ++n) {
    EXPECT_TRUE(hosts.is_new({n}));
    EXPECT_FALSE(hosts.is_new({n}));
  }
  EXPECT_FALSE(hosts.is_new({200}));
}

}  // namespace
}  // namespace orbwatch::app::modbus
