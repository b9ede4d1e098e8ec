// SPDX-License-Identifier: Apache-2.0
#include "hal/network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace orbwatch::hal {
namespace {

using testing::HasSubstr;

HostAddress host(const std::string& text) {
  const auto address = parse_host(text);
  if (!address) throw std::invalid_argument(text);
  return *address;
}

bool contains(const std::string& network, const std::string& machine) {
  const auto parsed = parse_network(network);
  EXPECT_TRUE(parsed) << parsed.error().message;
  return parsed && parsed->contains(host(machine));
}

TEST(Network, IsOneMachineOrAllWithItsPrefix) {
  EXPECT_TRUE(contains("10.0.0.7", "10.0.0.7"));
  EXPECT_FALSE(contains("10.0.0.7", "10.0.0.6"));
  EXPECT_TRUE(contains("10.0.0.0/24", "10.0.0.255"));
  EXPECT_FALSE(contains("10.0.0.0/24", "10.0.1.0"));
  EXPECT_TRUE(contains("172.16.0.0/12", "172.31.255.255"));
  EXPECT_FALSE(contains("172.16.0.0/12", "172.32.0.0"));
  EXPECT_TRUE(contains("10.0.0.6/31", "10.0.0.7"));
  EXPECT_FALSE(contains("10.0.0.6/32", "10.0.0.7"));
  EXPECT_TRUE(contains("fd00::/8", "fdff:1::2"));
  EXPECT_FALSE(contains("fd00::/8", "fc00::1"));
  EXPECT_TRUE(contains("fe80::/10", "febf::1"));
  EXPECT_FALSE(contains("fe80::/10", "fec0::1"));
  EXPECT_TRUE(contains("2001:db8::1", "2001:db8::1"));
}

TEST(Network, OfOneProtocolHoldsNobodyOfTheOther) {
  EXPECT_TRUE(contains("0.0.0.0/0", "255.255.255.255"));
  EXPECT_FALSE(contains("0.0.0.0/0", "fd00::1"));
  // The prefix ::/0 contains every address; a listener on :: reports IPv4 clients as
  // ::ffff:a.b.c.d.
  EXPECT_TRUE(contains("::/0", "10.0.0.1"));
  EXPECT_TRUE(contains("10.0.0.0/8", "::ffff:10.1.2.3"));
}

TEST(Network, IsEverybodyWithAPrefixOfNothing) {
  for (const char* all : {"0.0.0.0/0", "::/0", "::ffff:0:0/96"}) {
    EXPECT_TRUE(is_everybody(parse_network(all).value())) << all;
  }
  for (const char* some : {"0.0.0.0/1", "10.0.0.7", "fd00::/8", "::1"}) {
    EXPECT_FALSE(is_everybody(parse_network(some).value())) << some;
  }
}

TEST(HostAddress, IsWrittenAsItIsRead) {
  for (const char* text : {"10.0.0.7", "fd00::1", "::1", "127.0.0.1"}) {
    EXPECT_EQ(text_of(host(text)), text);
  }
  EXPECT_EQ(text_of(host("::ffff:10.0.0.7")), "10.0.0.7");
}

TEST(HostAddress, IsLoopbackOfEitherProtocol) {
  for (const char* own : {"127.0.0.1", "127.8.8.8", "::1", "::ffff:127.0.0.1"}) {
    EXPECT_TRUE(is_loopback(host(own))) << own;
    EXPECT_TRUE(is_loopback(std::string(own))) << own;
  }
  for (const char* other : {"0.0.0.0", "::", "10.0.0.1", "128.0.0.1", "::2", "::127.0.0.1"}) {
    EXPECT_FALSE(is_loopback(host(other))) << other;
    EXPECT_FALSE(is_loopback(std::string(other))) << other;
  }
  EXPECT_FALSE(is_loopback(std::string("localhost")));
}

TEST(HostAddress, IsOfOneProtocol) {
  for (const char* v4 : {"10.0.0.7", "0.0.0.0", "::ffff:10.0.0.7"})
    EXPECT_TRUE(is_v4(host(v4))) << v4;
  for (const char* v6 : {"fd00::1", "::", "::10.0.0.7"}) EXPECT_FALSE(is_v4(host(v6))) << v6;
}

TEST(Network, SaysWhatIsWrong) {
  const auto error = [](const std::string& text) {
    const auto network = parse_network(text);
    return network ? "accepted" : network.error().message;
  };
  for (const char* text : {"", "plc", "10.0.0", "10.0.0.0.0", "/8", "fe80::1%eth0", " 10.0.0.1"}) {
    EXPECT_THAT(error(text), HasSubstr("'" + std::string(text) + "' is not a numeric")) << text;
  }
  for (const char* text : {"10.0.0.0/", "10.0.0.0/33", "10.0.0.0/-1", "10.0.0.0/+8", "10.0.0.0/8 ",
                           "10.0.0.0/8/8", "10.0.0.0/99999999999"}) {
    EXPECT_THAT(error(text), HasSubstr("prefix length of 0 to 32")) << text;
  }
  EXPECT_THAT(error("fd00::/129"), HasSubstr("0 to 128"));
  EXPECT_THAT(error("10.0.0.7/24"), HasSubstr("bits set after its first 24"));
  EXPECT_THAT(error("10.0.0.1/0"), HasSubstr("bits set"));
  EXPECT_THAT(error("fd00::1/8"), HasSubstr("bits set"));
}

}  // namespace
}  // namespace orbwatch::hal
