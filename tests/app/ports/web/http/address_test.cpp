// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/address.h"

#include <gtest/gtest.h>

namespace orbwatch::app::web {
namespace {

TEST(OwnHost, IsAnAddressLocalhostOrAName) {
  const std::vector<std::string> names{"ball.plant.example"};
  for (const char* own : {"127.0.0.1", "10.0.0.7:8080", "[fd00::1]", "[fd00::1]:8080", "localhost",
                          "LocalHost:1", "localhost.", "ball.plant.example", "ball.plant.example.",
                          "ball.plant.example.:80", "BALL.plant.example:443"}) {
    EXPECT_TRUE(is_own_host(own, names)) << own;
  }
  for (const char* other :
       {"", ":80", "evil.example", "evil.example:8080", "127.0.0.1.evil.example", "localhost.evil",
        "127.0.0.1:", "127.0.0.1:http", "127.0.0.1:123456", "[fd00::1", "[fd00::1]x", "[127.0.0.1]",
        "fd00::1", "ball.plant.example..", ".", "ball", "127.0.0.1@evil.example"}) {
    EXPECT_FALSE(is_own_host(other, names)) << other;
  }
  EXPECT_FALSE(is_own_host(std::string_view("127.0.0.1\0.evil.example", 23), names));
}

}  // namespace
}  // namespace orbwatch::app::web
