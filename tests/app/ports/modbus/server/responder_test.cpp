// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/responder.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <random>

#include "tests/app/ports/modbus/clients.h"
#include "tests/support/share.h"

namespace orbwatch::app::modbus {
namespace {

using tests::Bytes;
using tests::frame;

/// A responder with a process image that does not change, on one end of a socket pair.
class ResponderTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, sockets_), 0);
    ends_[0] = hal::FileDescriptor(sockets_[0]);
    ends_[1] = hal::FileDescriptor(sockets_[1]);
    image_.live.status = tests::example_status();
    image_.now = image_.live.status.stamp + std::chrono::milliseconds(0x0012'0034);
    image_.live.utc = std::chrono::microseconds(1'700'000'000'654'321);
    image_.server = {
        .answered = 0x0011'0001, .refused = 0x0022'0002, .dropped = 0x0033'0003, .connections = 4};
    auto responder = Responder::create(
        map_,
        [this](const Write& write) -> std::optional<Exception> {
          apply(write, map_, written_);
          return refusal_;
        },
        [this] { return image_; });
    ASSERT_TRUE(responder) << responder.error().message;
    responder_ = std::move(*responder);
    use({0, 1, 255});
  }

  void use(std::vector<int> unit_ids) {
    auto transport = TcpTransport::create(std::move(unit_ids));
    ASSERT_TRUE(transport) << transport.error().message;
    transport_ = std::move(*transport);
    transport_->use(sockets_[0]);
  }

  Outcome answer(const Bytes& request) { return responder_->answer(*transport_, request, true); }

  /// The answer to a complete frame; empty: none.
  Bytes exchange(const Bytes& request) {
    answered_ = answer(request);
    Bytes answer(300);
    const auto got = ::recv(sockets_[1], answer.data(), answer.size(), MSG_DONTWAIT);
    answer.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return answer;
  }

  /// Registers as received.
  Bytes read(std::uint8_t function, int address, int count) {
    const Bytes answer =
        exchange(frame({function, static_cast<std::uint8_t>(address >> 8),
                        static_cast<std::uint8_t>(address), 0, static_cast<std::uint8_t>(count)}));
    EXPECT_EQ(answered_, Outcome::Answered) << address;
    return answer.size() > 9 ? Bytes(answer.begin() + 9, answer.end()) : Bytes{};
  }

  RegisterMap map_;
  ProcessImage image_;
  PlcRegisters written_;
  std::optional<Exception> refusal_;  ///< of the owner of the registers
  std::unique_ptr<Responder> responder_;
  std::unique_ptr<TcpTransport> transport_;
  Outcome answered_ = Outcome::NotSent;
  int sockets_[2] = {-1, -1};
  hal::FileDescriptor ends_[2];
};

TEST_F(ResponderTest, EveryRowIsReadableAndItsMirrorReadsTheSame) {
  int not_zero = 0;
  for (const Row& row : map_.rows()) {
    if (row.table != Table::Input && row.table != Table::Discrete) continue;
    if (row.count > 125) continue;  // reserved, larger than one request
    const bool input = row.table == Table::Input;
    const Bytes direct = read(input ? 4 : 2, row.address, row.count);
    const Bytes mirror = read(input ? 3 : 1, row.address + 5000, row.count);
    ASSERT_EQ(direct.size(), static_cast<std::size_t>(input ? 2 * row.count : (row.count + 7) / 8))
        << row.name;
    EXPECT_EQ(direct, mirror) << row.name;
    not_zero += direct != Bytes(direct.size(), 0) ? 1 : 0;
  }
  EXPECT_GT(not_zero, 30);
}

TEST_F(ResponderTest, BytesStandHighWordFirstAtTheDocumentedPlaces) {
  const auto input = [this](const char* name, int count) {
    return read(4, tests::address_of(name), count);
  };
  EXPECT_EQ(input("map_version", 1), (Bytes{0, 3}));
  EXPECT_EQ(input("status_bits", 2), (Bytes{0, 0, 0, 0b0010'0010}));
  EXPECT_EQ(input("measurement_bits", 2), (Bytes{0, 0, 1, 1}));
  EXPECT_EQ(input("fault_bits", 2), (Bytes{0, 0b10, 0, 0}));  // camera 1 has a fault
  EXPECT_EQ(input("utc_seconds", 4), (Bytes{0x65, 0x53, 0xf1, 0, 0, 9, 0xfb, 0xf1}));
  EXPECT_EQ(input("system_state", 1), (Bytes{0, 2}));
  EXPECT_EQ(input("system_heartbeat", 2), (Bytes{0, 1, 1, 2}));
  EXPECT_EQ(input("system_frame_set", 4), (Bytes{0x80, 0x01, 0x02, 0x03, 0, 0x12, 0, 0x34}));
  EXPECT_EQ(input("system_recipe", 1), (Bytes{0, 7}));
  EXPECT_EQ(input("system_configuration_checksum", 2), (Bytes{0x89, 0xab, 0xcd, 0xef}));
  EXPECT_EQ(input("system_selected_view", 1), (Bytes{0, 2}));
  EXPECT_EQ(input("system_overruns", 4), (Bytes{0, 0x11, 3, 4, 0, 0x22, 4, 5}));
  EXPECT_EQ(input("system_load", 2), (Bytes{0, 0, 1, 201}));  // 45.7 %
  EXPECT_EQ(input("modbus_answered", 6), (Bytes{0, 0x11, 0, 1, 0, 0x22, 0, 2, 0, 0x33, 0, 3}));
  EXPECT_EQ(input("modbus_connections", 2), (Bytes{0, 0, 0, 4}));
  EXPECT_EQ(input("camera_1_fault", 1), (Bytes{0, 2}));
  EXPECT_EQ(input("camera_1_frames_per_second", 2), (Bytes{0, 0, 4, 226}));
  EXPECT_EQ(input("camera_1_frames", 6), (Bytes{0, 0x66, 8, 9, 0, 0x77, 9, 10, 0, 0x88, 10, 11}));
  EXPECT_EQ(input("camera_3_fault", 1), (Bytes{0xff, 0xff}));  // there is no camera 3
  EXPECT_EQ(input("view_2_published", 4), (Bytes{0, 0x99, 11, 12, 0, 0xaa, 12, 13}));
  EXPECT_EQ(input("view_2_frames_per_second", 6),
            (Bytes{0, 0, 9, 196, 0, 0, 1, 157, 0, 0, 3, 108}));
  EXPECT_EQ(read(2, tests::bit_of("running"), 16), (Bytes{0b0010'0010, 0}));
  EXPECT_EQ(read(2, tests::bit_of("camera_0_delivers"), 16), (Bytes{0b0000'0001, 0b0000'0001}));
}

TEST_F(ResponderTest, ReadingWithAWriteTellsWhatTheWriteHasLedTo) {
  const Row& row = *std::ranges::find(map_.rows(), "result_acknowledged", &Row::name);
  const auto address = static_cast<std::uint8_t>(row.address);
  const Bytes answer =
      exchange(frame({23, 0, address, 0, 2, 0, address, 0, 2, 4, 0x12, 0x34, 0x56, 0x78}));
  EXPECT_EQ(answered_, Outcome::Answered);
  ASSERT_EQ(answer.size(), 13U);
  EXPECT_EQ(Bytes(answer.begin() + 4, answer.begin() + 9), (Bytes{0, 7, 1, 23, 4}));
  EXPECT_EQ(Bytes(answer.begin() + 9, answer.end()), read(3, row.address, 2))
      << "there is no such result";
  EXPECT_NE(read(3, row.address, 2), (Bytes{0x12, 0x34, 0x56, 0x78}));
}

TEST_F(ResponderTest, ARefusalOfTheRegistersOwnerIsTheAnswer) {
  refusal_ = Exception::IllegalDataValue;
  const auto address = static_cast<std::uint8_t>(tests::address_of("plc_heartbeat"));
  const Bytes single = exchange(frame({6, 0, address, 0, 1}));
  EXPECT_EQ(answered_, Outcome::Refused);
  EXPECT_EQ(Bytes(single.begin() + 7, single.end()), (Bytes{0x86, 3}));
  const Bytes both = exchange(frame({0x17, 0, address, 0, 1, 0, address, 0, 1, 2, 0, 1}));
  EXPECT_EQ(Bytes(both.begin() + 7, both.end()), (Bytes{0x97, 3}));
}

TEST_F(ResponderTest, AnswersItsUnitsOnly) {
  use({0, 7, 200});
  for (int unit = 0; unit < 256; ++unit) {
    const Bytes answer = exchange(frame({4, 0, 0, 0, 1}, static_cast<std::uint8_t>(unit)));
    const bool ours = unit == 0 || unit == 7 || unit == 200;
    ASSERT_EQ(answer.size(), ours ? 11U : 9U) << unit;
    EXPECT_EQ(answer[6], unit);
    if (!ours) {
      EXPECT_EQ(Bytes(answer.begin() + 7, answer.end()), (Bytes{0x84, 11}));
      EXPECT_EQ(answered_, Outcome::Refused);
    }
  }
}

TEST_F(ResponderTest, AnswersDeviceIdentification) {
  const Bytes answer = exchange(frame({43, 14, 4, 1}, 1, 0xabcd));
  EXPECT_EQ(answered_, Outcome::Answered);
  const Bytes expected = {0xab, 0xcd, 0, 0, 0,   18,  1,   43,  14,  4,   0x81, 0,
                          0,    1,    1, 8, 'o', 'r', 'b', 'w', 'a', 't', 'c',  'h'};
  EXPECT_EQ(answer, expected);
  EXPECT_EQ(exchange(frame({43, 14, 4, 9})), frame({0xab, 2}));
  EXPECT_EQ(answered_, Outcome::Refused);
}

TEST_F(ResponderTest, AFrameThatIsAnAnswerIsNotModbus) {
  EXPECT_TRUE(exchange(frame({0x84, 2})).empty());
  EXPECT_EQ(answered_, Outcome::NotModbus);
}

TEST_F(ResponderTest, SaysWhenTheClientIsGone) {
  ends_[1] = hal::FileDescriptor();  // closed at the end of this statement
  EXPECT_EQ(answer(frame({4, 0, 0, 0, 1})), Outcome::NotSent);
  EXPECT_EQ(answer(frame({4, 9, 9, 0, 1})), Outcome::NotSent);
  EXPECT_EQ(answer(frame({43, 14, 1, 0})), Outcome::NotSent);
}

TEST_F(ResponderTest, EveryAnswerToDamagedRequestsIsWellFormed) {
  const Bytes requests[] = {{1, 0x13, 0x88, 0, 12},
                            {2, 0, 0, 0, 16},
                            {3, 0x17, 0x70, 0, 125},
                            {4, 0, 0, 0, 96},
                            {5, 0x13, 0x88, 255, 0},
                            {6, 0, 12, 0, 1},
                            {15, 0x13, 0x88, 0, 9, 2, 1, 1},
                            {16, 0, 8, 0, 5, 10, 0, 0, 0, 1, 0, 1, 0, 1, 0, 7},
                            {22, 0, 12, 255, 0, 0, 1},
                            {23, 0, 0, 0, 7, 0, 11, 0, 2, 4, 0, 1, 0, 9},
                            {43, 14, 1, 0}};
  std::mt19937 random(20240502);
  std::uniform_int_distribution<std::size_t> any(0, 1000000);
  int done = 0;
  int refused = 0;
  const int cases = orbwatch::tests::share_of(50000);
  for (int i = 0; i < cases; ++i) {
    Bytes pdu = requests[any(random) % std::size(requests)];
    pdu[any(random) % pdu.size()] ^= static_cast<std::uint8_t>(1U << any(random) % 8);
    pdu[any(random) % pdu.size()] ^= static_cast<std::uint8_t>(any(random) & any(random) & 0x11);
    if (any(random) % 8 == 0) pdu.resize(1 + any(random) % 16);
    pdu[0] &= 0x7f;
    const Bytes answer = exchange(frame(pdu));
    ASSERT_GE(answer.size(), 9U);
    ASSERT_LE(answer.size(), 260U);
    EXPECT_EQ(Bytes(answer.begin(), answer.begin() + 4), (Bytes{0x12, 0x34, 0, 0}));
    EXPECT_EQ(static_cast<std::size_t>(answer[4] << 8 | answer[5]), answer.size() - 6);
    EXPECT_EQ(answer[7], answered_ == Outcome::Answered ? pdu[0] : pdu[0] | 0x80);
    ++(answered_ == Outcome::Answered ? done : refused);
  }
  EXPECT_GT(done, cases / 50);
  EXPECT_GT(refused, cases / 50);
}

}  // namespace
}  // namespace orbwatch::app::modbus
