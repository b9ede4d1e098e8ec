// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/app/ports/modbus/clients.h"
#include "tests/support/share.h"

namespace orbwatch::app::modbus {
namespace {

using testing::ElementsAre;
using tests::Bytes;

std::optional<Exception> refusal(const Bytes& pdu) {
  const auto request = parse(pdu);
  return request ? std::nullopt : std::optional(request.error());
}

/// Function code, address, count, then `data` zero bytes.
Bytes pdu(std::uint8_t function, int count, std::vector<int> rest = {}, std::size_t data = 0) {
  Bytes bytes{function, 0, 0, static_cast<std::uint8_t>(count >> 8),
              static_cast<std::uint8_t>(count)};
  for (const int byte : rest) bytes.push_back(static_cast<std::uint8_t>(byte));
  bytes.resize(bytes.size() + data);
  return bytes;
}

TEST(Request, ReadsNameTheirTable) {
  const std::pair<std::uint8_t, Table> tables[] = {
      {1, Table::Coil}, {2, Table::Discrete}, {3, Table::Holding}, {4, Table::Input}};
  for (const auto& [function, table] : tables) {
    const auto request = parse(Bytes{function, 0x12, 0x34, 0, 5});
    ASSERT_TRUE(request);
    EXPECT_FALSE(request->write || request->mask);
    EXPECT_EQ(request->read->table, table);
    EXPECT_EQ(request->read->address, 0x1234);
    EXPECT_EQ(request->read->count, 5);
  }
}

TEST(Request, WritesCarryTheirValues) {
  const auto coil = parse(Bytes{5, 0, 9, 0xff, 0});
  ASSERT_TRUE(coil);
  EXPECT_EQ(coil->write->range.table, Table::Coil);
  EXPECT_THAT(coil->write->values, ElementsAre(1));

  const auto coils = parse(Bytes{15, 0, 9, 0, 10, 2, 0b10000101, 0b10});
  ASSERT_TRUE(coils);
  EXPECT_EQ(coils->write->range.count, 10);
  EXPECT_THAT(coils->write->values, ElementsAre(1, 0, 1, 0, 0, 0, 0, 1, 0, 1));

  const auto one = parse(Bytes{6, 0, 9, 0x12, 0x34});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->write->range.table, Table::Holding);
  EXPECT_THAT(one->write->values, ElementsAre(0x1234));

  const auto many = parse(Bytes{16, 0, 9, 0, 2, 4, 1, 2, 3, 4});
  ASSERT_TRUE(many);
  EXPECT_EQ(many->write->range.address, 9);
  EXPECT_THAT(many->write->values, ElementsAre(0x0102, 0x0304));

  const auto both = parse(Bytes{23, 0, 1, 0, 2, 0, 3, 0, 1, 2, 0xab, 0xcd});
  ASSERT_TRUE(both);
  EXPECT_EQ(both->read->address, 1);
  EXPECT_EQ(both->read->count, 2);
  EXPECT_EQ(both->write->range.address, 3);
  EXPECT_THAT(both->write->values, ElementsAre(0xabcd));
}

TEST(Request, QuantitiesAreLimitedAsTheStandardSays) {
  const std::pair<std::uint8_t, int> limits[] = {{1, 2000}, {2, 2000}, {3, 125}, {4, 125}};
  for (const auto& [function, limit] : limits) {
    EXPECT_EQ(refusal(pdu(function, 0)), Exception::IllegalDataValue);
    EXPECT_TRUE(parse(pdu(function, limit)));
    EXPECT_EQ(refusal(pdu(function, limit + 1)), Exception::IllegalDataValue);
  }
  EXPECT_TRUE(parse(pdu(15, 1968, {246}, 246)));
  EXPECT_EQ(refusal(pdu(15, 1969, {247}, 247)), Exception::IllegalDataValue);
  EXPECT_EQ(refusal(pdu(15, 0, {0})), Exception::IllegalDataValue);
  EXPECT_TRUE(parse(pdu(16, 123, {246}, 246)));
  EXPECT_EQ(refusal(pdu(16, 124, {248}, 248)), Exception::IllegalDataValue);
  EXPECT_EQ(refusal(pdu(16, 0, {0})), Exception::IllegalDataValue);
  EXPECT_TRUE(parse(pdu(23, 125, {0, 0, 0, 121, 242}, 242)));
  EXPECT_EQ(refusal(pdu(23, 126, {0, 0, 0, 121, 242}, 242)), Exception::IllegalDataValue);
  EXPECT_EQ(refusal(pdu(23, 125, {0, 0, 0, 122, 244}, 244)), Exception::IllegalDataValue);
  EXPECT_EQ(refusal(pdu(23, 0, {0, 0, 0, 1, 2}, 2)), Exception::IllegalDataValue);
  EXPECT_EQ(refusal(pdu(23, 1, {0, 0, 0, 0, 0})), Exception::IllegalDataValue);
}

TEST(Request, LengthsMustAgree) {
  const Bytes whole[] = {pdu(1, 1),          pdu(2, 1),
                         pdu(3, 1),          pdu(4, 1),
                         pdu(5, 0),          pdu(6, 1),
                         pdu(15, 9, {2}, 2), pdu(16, 2, {4}, 4),
                         pdu(22, 0, {0, 0}), pdu(23, 1, {0, 0, 0, 1, 2}, 2)};
  for (const Bytes& request : whole) {
    EXPECT_TRUE(parse(request)) << int{request[0]};
    for (std::size_t size = 1; size < request.size(); ++size) {
      EXPECT_EQ(refusal(Bytes(request.begin(), request.begin() + static_cast<long>(size))),
                Exception::IllegalDataValue)
          << int{request[0]} << " cut to " << size;
    }
    Bytes longer = request;
    longer.push_back(0);
    EXPECT_EQ(refusal(longer), Exception::IllegalDataValue) << int{request[0]};
  }
  EXPECT_EQ(refusal(pdu(16, 2, {3}, 4)), Exception::IllegalDataValue);  // byte count is wrong
  EXPECT_EQ(refusal(pdu(15, 9, {1}, 2)), Exception::IllegalDataValue);
  EXPECT_EQ(refusal(Bytes{5, 0, 9, 0xff, 1}), Exception::IllegalDataValue);  // neither on nor off
}

TEST(Request, SaysHowLongItIsFromItsBeginning) {
  const Bytes whole[] = {pdu(1, 1),          pdu(2, 1),
                         pdu(3, 1),          pdu(4, 1),
                         pdu(5, 0),          pdu(6, 1),
                         pdu(15, 9, {2}, 2), pdu(16, 2, {4}, 4),
                         pdu(22, 0, {0, 0}), pdu(23, 1, {0, 0, 0, 1, 2}, 2),
                         {43, 14, 1, 0}};
  for (const Bytes& request : whole) {
    for (std::size_t size = 1; size < request.size(); ++size) {
      const auto length = request_length(std::span(request).first(size));
      ASSERT_TRUE(length);
      EXPECT_GT(*length, size) << int{request[0]};
      EXPECT_LE(*length, request.size()) << int{request[0]};
    }
    EXPECT_EQ(request_length(request), request.size()) << int{request[0]};
  }
  for (const std::uint8_t function : {0, 7, 8, 17, 20, 24, 99, 131, 255}) {
    EXPECT_EQ(request_length(Bytes{function, 1, 2, 3}), std::nullopt);
  }
}

TEST(Request, OtherFunctionsAreRefused) {
  const std::string served = "\1\2\3\4\5\6\17\20\26\27";
  for (int function = 0; function < 256; ++function) {
    if (served.find(static_cast<char>(function)) != served.npos) continue;
    EXPECT_EQ(refusal(pdu(static_cast<std::uint8_t>(function), 1)), Exception::IllegalFunction);
  }
}

TEST(Request, NoiseIsEitherRefusedOrInRange) {
  std::mt19937 random(20240501);
  std::uniform_int_distribution<int> byte(0, 255);
  int accepted = 0;
  const int cases = orbwatch::tests::share_of(200000);
  for (int i = 0; i < cases; ++i) {
    Bytes noise(static_cast<std::size_t>(1 + byte(random) % 16));
    for (auto& value : noise) value = static_cast<std::uint8_t>(byte(random) & byte(random));
    const auto request = parse(noise);
    if (!request) continue;
    ++accepted;
    ASSERT_TRUE(request->read || request->write || request->mask);
    if (request->write) {
      ASSERT_EQ(request->write->values.size(),
                static_cast<std::size_t>(request->write->range.count));
    }
  }
  EXPECT_GT(accepted, cases / 2000);
}

TEST(Request, DoubleWordsAreWrittenWhole) {
  const RegisterMap map;
  const auto check_write = [&](int address, std::vector<std::uint16_t> values) {
    const int count = static_cast<int>(values.size());
    return check(Write{{Table::Holding, address, count}, std::move(values)}, map);
  };
  // argument_0 is at 0; command, command_sequence and acknowledged_sequence are at 11 to 13.
  EXPECT_EQ(check_write(0, {0, 1}), std::nullopt);
  EXPECT_EQ(check_write(0, {0, 1, 1, 1}), std::nullopt);
  EXPECT_EQ(check_write(0, {0}), Exception::IllegalDataAddress);
  EXPECT_EQ(check_write(1, {1}), Exception::IllegalDataAddress);
  EXPECT_EQ(check_write(1, {1, 1}), Exception::IllegalDataAddress);
  // overlaps a read-only register
  EXPECT_EQ(check_write(12, {1, 1}), Exception::IllegalDataAddress);
  EXPECT_EQ(check_write(11, {999}), Exception::IllegalDataValue);
  // addresses are checked first
  EXPECT_EQ(check_write(11, {999, 1, 1}), Exception::IllegalDataAddress);
  EXPECT_EQ(check_write(65535, {1, 1}), Exception::IllegalDataAddress);
}

}  // namespace
}  // namespace orbwatch::app::modbus
