// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/access_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbwatch::app::modbus {
namespace {

using testing::HasSubstr;

HostAddress host(const std::string& text) {
  const auto address = hal::parse_host(text);
  if (!address) throw std::invalid_argument(text);
  return *address;
}

/// The server's own address in these tests.
const HostAddress kServer = host("10.0.0.1");

TEST(AccessList, LetsEverybodyReadAndItsOwnHostWriteUnlessToldOtherwise) {
  const AccessList list;
  for (const char* other : {"192.0.2.1", "10.0.0.2", "fd00::1", "128.0.0.1", "::2"}) {
    EXPECT_EQ(list.of(host(other), kServer), Permission::Read) << other;
  }
  for (const char* own : {"10.0.0.1", "127.0.0.1", "127.8.9.10", "::1"}) {
    EXPECT_EQ(list.of(host(own), kServer), Permission::Write) << own;
  }
}

TEST(AccessList, WritersMayReadToo) {
  const auto list = AccessList::create({"10.0.0.0/24"}, {"10.1.0.7", "fd00::/8"});
  ASSERT_TRUE(list);
  EXPECT_EQ(list->of(host("10.0.0.9"), kServer), Permission::Read);
  EXPECT_EQ(list->of(host("10.1.0.7"), kServer), Permission::Write);
  EXPECT_EQ(list->of(host("fd12::1"), kServer), Permission::Write);
  EXPECT_EQ(list->of(host("10.1.0.8"), kServer), Permission::None);
  EXPECT_EQ(list->of(kServer, kServer), Permission::Read) << "the list names all writers";
}

TEST(AccessList, WithoutWritersReadersElsewhereMayNotWrite) {
  const auto list = AccessList::create({"10.0.0.0/24"}, {});
  ASSERT_TRUE(list);
  EXPECT_EQ(list->of(host("10.0.0.9"), kServer), Permission::Read);
  EXPECT_EQ(list->of(kServer, kServer), Permission::Write);
  EXPECT_EQ(list->of(host("10.1.0.9"), kServer), Permission::None);
  EXPECT_EQ(list->of(host("127.0.0.1"), kServer), Permission::None);
}

TEST(AccessList, WithoutReadersAllMayRead) {
  const auto list = AccessList::create({}, {"10.1.0.7"});
  ASSERT_TRUE(list);
  EXPECT_EQ(list->of(host("10.0.0.9"), kServer), Permission::Read);
  EXPECT_EQ(list->of(host("10.1.0.7"), kServer), Permission::Write);
}

TEST(AccessList, SaysWhichListIsWrong) {
  EXPECT_THAT(AccessList::create({"x"}, {}).error().message, HasSubstr("readers: 'x'"));
  EXPECT_THAT(AccessList::create({}, {"y"}).error().message, HasSubstr("writers: 'y'"));
}

}  // namespace
}  // namespace orbwatch::app::modbus
