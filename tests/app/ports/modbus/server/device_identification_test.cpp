// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/device_identification.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/app/ports/modbus/clients.h"

namespace orbwatch::app::modbus {
namespace {

using tests::Bytes;

/// Object ids and texts of an answer, parsed by the standard's layout.
std::vector<std::pair<int, std::string>> objects(const Bytes& pdu) {
  std::vector<std::pair<int, std::string>> list;
  std::size_t at = 7;
  for (int left = pdu.at(6); left > 0; --left) {
    const std::size_t length = pdu.at(at + 1);
    list.emplace_back(pdu.at(at), std::string(pdu.begin() + static_cast<long>(at) + 2,
                                              pdu.begin() + static_cast<long>(at + 2 + length)));
    at += 2 + length;
  }
  EXPECT_EQ(at, pdu.size());
  return list;
}

TEST(DeviceIdentification, NamesTheDevice) {
  for (const std::uint8_t category : {1, 2, 3}) {
    const auto answer = identify(Bytes{43, 14, category, 0});
    ASSERT_TRUE(answer);
    EXPECT_EQ((*answer)[0], 43);
    EXPECT_EQ((*answer)[1], 14);
    EXPECT_EQ((*answer)[2], category);
    EXPECT_EQ((*answer)[3], 0x81);
    EXPECT_EQ((*answer)[4], 0);
    const auto list = objects(*answer);
    ASSERT_EQ(list.size(), 3U);
    EXPECT_EQ(list[1], std::pair(1, std::string("orbwatch")));
    EXPECT_FALSE(list[2].second.empty());
  }
}

TEST(DeviceIdentification, StreamsFromAnObjectOnAndGivesSingleOnes) {
  EXPECT_EQ(objects(*identify(Bytes{43, 14, 1, 2})).size(), 1U);
  // an unknown object: from the beginning
  EXPECT_EQ(objects(*identify(Bytes{43, 14, 1, 99})).size(), 3U);
  const auto single = objects(*identify(Bytes{43, 14, 4, 1}));
  ASSERT_EQ(single.size(), 1U);
  EXPECT_EQ(single[0].first, 1);
}

TEST(DeviceIdentification, RefusesTheRest) {
  EXPECT_EQ(identify(Bytes{43, 14, 4, 3}).error(), Exception::IllegalDataAddress);
  EXPECT_EQ(identify(Bytes{43, 14, 0, 0}).error(), Exception::IllegalDataValue);
  EXPECT_EQ(identify(Bytes{43, 14, 5, 0}).error(), Exception::IllegalDataValue);
  EXPECT_EQ(identify(Bytes{43, 14, 1}).error(), Exception::IllegalDataValue);
  EXPECT_EQ(identify(Bytes{43, 13, 1, 0}).error(), Exception::IllegalFunction);
  EXPECT_EQ(identify(Bytes{43}).error(), Exception::IllegalFunction);
}

}  // namespace
}  // namespace orbwatch::app::modbus
