// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/participant/network_addresses.h"

#include <gmock/gmock.h>
#include <sys/socket.h>

#include "tests/app/ports/dds/participant/bound_socket.h"

namespace orbwatch::app::dds {
namespace {

using tests::bound_socket;

const NetworkAddress kLoopback{"lo", "127.0.0.1"}, kWire{"eth0", "192.168.0.7"},
    kOtherWire{"eth0", "192.168.0.8"}, kContainers{"docker0", "172.17.0.1"};

TEST(InterfaceWatch, OnlyInterfacesInUseCount) {
  InterfaceWatch watch;
  watch.joined({kWire, kLoopback}, {kWire.address});
  EXPECT_FALSE(watch.is_change({kWire, kLoopback}, {kContainers, kWire, kLoopback}));
  EXPECT_FALSE(watch.is_change({kWire, kLoopback}, {kWire}));
  EXPECT_TRUE(watch.is_change({kWire, kLoopback}, {kOtherWire, kLoopback}));
  EXPECT_TRUE(watch.is_change({kWire, kLoopback}, {kLoopback}));
}

TEST(InterfaceWatch, AnInterfaceThatWentMayComeBack) {
  InterfaceWatch watch;
  watch.joined({kContainers, kWire}, {kWire.address});
  watch.left();
  watch.joined({kContainers}, {kContainers.address});
  EXPECT_TRUE(watch.is_change({kContainers}, {kContainers, kWire}));
  EXPECT_FALSE(watch.is_change({kContainers}, {kContainers, kLoopback}));
}

TEST(InterfaceWatch, WithoutANetworkAnyIsWelcome) {
  InterfaceWatch watch;
  EXPECT_TRUE(watch.is_change({}, {kWire})) << "before joining";
  watch.joined({kLoopback}, {kLoopback.address});
  EXPECT_TRUE(watch.is_change({kLoopback}, {kLoopback, kContainers}));
  watch.joined({kContainers, kLoopback}, {kLoopback.address});
  EXPECT_FALSE(watch.is_change({kContainers, kLoopback}, {kContainers, kWire, kLoopback}))
      << "the profile chose the loopback interface";
}

TEST(InterfaceWatch, UnknownSocketsMakeEveryInterfaceCount) {
  InterfaceWatch watch;
  watch.joined({kWire, kLoopback}, {});
  EXPECT_TRUE(watch.is_change({kWire, kLoopback}, {kContainers, kWire, kLoopback}));
}

TEST(BoundAddresses, AreThoseOfUdpSocketsForOneAddress) {
  const auto udp = bound_socket(SOCK_DGRAM, "127.0.0.77"),
             tcp = bound_socket(SOCK_STREAM, "127.0.0.78"),
             all = bound_socket(SOCK_DGRAM, "0.0.0.0");
  const auto bound = bound_addresses();
  EXPECT_THAT(bound, testing::Contains("127.0.0.77"));
  EXPECT_THAT(bound, testing::Not(testing::Contains("127.0.0.78")));
  EXPECT_THAT(bound, testing::Not(testing::Contains("0.0.0.0")));
}

TEST(BoundAddresses, AreWithoutThoseOfEarlierSockets) {
  const auto camera = bound_socket(SOCK_DGRAM, "127.0.0.77");
  const auto earlier = open_sockets();
  const auto later = bound_socket(SOCK_DGRAM, "127.0.0.79");
  const auto bound = bound_addresses(earlier);
  EXPECT_THAT(bound, testing::Contains("127.0.0.79"));
  EXPECT_THAT(bound, testing::Not(testing::Contains("127.0.0.77")));
}

}  // namespace
}  // namespace orbwatch::app::dds
