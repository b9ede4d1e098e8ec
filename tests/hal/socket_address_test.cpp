// SPDX-License-Identifier: Apache-2.0
#include "hal/socket_address.h"

#include <gtest/gtest.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>
#include <string>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::hal {
namespace {

TEST(SocketAddress, IsReadWithItsPortAndFamily) {
  const auto v4 = parse_address("10.0.0.7", 8080);
  ASSERT_TRUE(v4);
  EXPECT_EQ(v4->family(), AF_INET);
  EXPECT_EQ(v4->length, sizeof(sockaddr_in));
  EXPECT_EQ(text_of(v4->host()), "10.0.0.7");
  EXPECT_EQ(v4->port(), 8080);
  const auto v6 = parse_address("fd00::1", 65535);
  ASSERT_TRUE(v6);
  EXPECT_EQ(v6->family(), AF_INET6);
  EXPECT_EQ(v6->length, sizeof(sockaddr_in6));
  EXPECT_EQ(text_of(v6->host()), "fd00::1");
  EXPECT_EQ(v6->port(), 65535);
}

TEST(SocketAddress, OfAMappedHostIsIpv4) {
  const auto address = parse_address("::ffff:10.0.0.7", 80);
  ASSERT_TRUE(address);
  EXPECT_EQ(address->family(), AF_INET);
  EXPECT_EQ(address->host(), parse_host("10.0.0.7"));
}

TEST(SocketAddress, IsNumeric) {
  for (const char* text : {"", "localhost", "ball.example", "10.0.0", "10.0.0.7:80", "[fd00::1]",
                           " 10.0.0.7", "010.0.0.7", "10.0.0.7/24"}) {
    EXPECT_FALSE(parse_address(text, 80)) << text;
  }
}

TEST(SocketAddress, OfIpv6HasAZone) {
  const unsigned loopback = ::if_nametoindex("lo");
  if (loopback == 0) GTEST_SKIP() << "there is no interface lo";
  const auto address = parse_address("fe80::1%lo", 80);
  ASSERT_TRUE(address);
  sockaddr_in6 v6{};
  std::memcpy(&v6, address->get(), sizeof(v6));
  EXPECT_EQ(v6.sin6_scope_id, loopback);
  EXPECT_EQ(text_of(address->host()), "fe80::1");
  for (const char* text : {"fe80::1%", "fe80::1%no-such", "10.0.0.7%lo", "%lo"}) {
    EXPECT_FALSE(parse_address(text, 80)) << text;
  }
}

TEST(SocketAddress, IsWhatTheSystemSays) {
  const FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const SocketAddress wanted(parse_host("127.0.0.1").value(), 0);
  ASSERT_EQ(::bind(socket.get(), wanted.get(), wanted.length), 0);
  SocketAddress bound;
  ASSERT_EQ(::getsockname(socket.get(), bound.get(), &bound.length), 0);
  EXPECT_EQ(bound.host(), wanted.host());
  EXPECT_GT(bound.port(), 0);
  const SocketAddress copy(bound.get());
  EXPECT_EQ(copy.host(), bound.host());
  EXPECT_EQ(copy.port(), bound.port());
  EXPECT_EQ(copy.length, bound.length);
}

TEST(SocketAddress, WithoutAFamilyIsNoHost) {
  EXPECT_EQ(SocketAddress().host(), HostAddress{});
  EXPECT_EQ(SocketAddress().port(), 0);
  sockaddr local{};
  local.sa_family = AF_UNIX;
  EXPECT_EQ(SocketAddress(&local).family(), AF_UNSPEC);
}

}  // namespace
}  // namespace orbwatch::hal
