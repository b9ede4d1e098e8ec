// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/rtu_framer.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/app/ports/modbus/clients.h"
#include "tests/support/share.h"

namespace orbwatch::app::modbus {
namespace {

using std::chrono::milliseconds;
using tests::Bytes;
using tests::rtu_frame;

constexpr int kUnit = 17;
constexpr milliseconds kNone{0};
constexpr milliseconds kPause{4};
constexpr milliseconds kLong{1000};

const Bytes kRead = rtu_frame(kUnit, {4, 0, 0, 0, 1});

/// A framer and the frames that it returns.
class RtuFramerTest : public testing::Test {
 protected:
  std::vector<Bytes> push(const Bytes& bytes, milliseconds silence) {
    framer_.push(bytes, silence);
    std::vector<Bytes> frames;
    while (const auto frame = framer_.next()) frames.emplace_back(frame->begin(), frame->end());
    return frames;
  }

  /// Pushes bytes, followed by silence of the line.
  std::vector<Bytes> push_last(const Bytes& bytes) {
    std::vector<Bytes> frames = push(bytes, kLong);
    if (!framer_.is_waiting()) return frames;
    framer_.end();
    while (const auto frame = framer_.next()) frames.emplace_back(frame->begin(), frame->end());
    EXPECT_FALSE(framer_.is_waiting());
    return frames;
  }

  RtuFramer framer_{kUnit, std::chrono::microseconds(1750)};
};

using Frames = std::vector<Bytes>;

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

TEST(RtuFrame, HasTheChecksumOfTheStandard) {
  // Modbus over Serial Line V1.02, 6.2.2: the checksum of 02 07 is 0x1241, sent low byte first.
  EXPECT_EQ(rtu_frame(2, {7}), (Bytes{2, 7, 0x41, 0x12}));
}

TEST(RtuPause, IsThreeAndAHalfCharacters) {
  using std::chrono::microseconds;
  EXPECT_EQ(rtu_pause(1200), microseconds(32083));
  EXPECT_EQ(rtu_pause(9600), microseconds(4010));
  EXPECT_EQ(rtu_pause(19200), microseconds(2005));
  EXPECT_EQ(rtu_pause(115200), microseconds(1750));
}

TEST_F(RtuFramerTest, EveryFunctionsRequestIsWholeAtOnce) {
  const Bytes pdus[] = {{1, 0, 0, 0, 1},
                        {2, 0, 0, 0, 1},
                        {3, 0, 0, 0, 1},
                        {4, 0, 0, 0, 1},
                        {5, 0, 0, 0xff, 0},
                        {6, 0, 0, 0, 1},
                        {15, 0, 0, 0, 9, 2, 1, 1},
                        {16, 0, 0, 0, 1, 2, 0, 9},
                        {22, 0, 0, 0, 1, 0, 2},
                        {23, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0, 9},
                        {43, 14, 1, 0},
                        // Unsupported functions, to be refused:
                        {7},
                        {8, 0, 0, 1, 2},
                        {20, 3, 6, 0, 1},
                        {43, 13, 1, 2},
                        {100, 1, 2, 3}};
  for (const Bytes& pdu : pdus) {
    for (const int unit : {kUnit, RtuFramer::kBroadcast}) {
      const Bytes frame = rtu_frame(unit, pdu);
      EXPECT_EQ(push(frame, kPause), Frames{frame}) << int{pdu[0]};
    }
  }
  EXPECT_EQ(framer_.errors(), 0U);
}

TEST_F(RtuFramerTest, AdaptersMayCutFramesAnywhereAndJoinThem) {
  Bytes longest = {16, 0, 0, 0, 123, 246};
  longest.resize(6 + 246);
  const Bytes frame = rtu_frame(kUnit, longest);
  for (std::size_t cut = 1; cut < frame.size(); ++cut) {
    const auto at = frame.begin() + static_cast<std::ptrdiff_t>(cut);
    EXPECT_EQ(push(Bytes(frame.begin(), at), kPause), Frames{});
    EXPECT_EQ(push(Bytes(at, frame.end()), milliseconds(16)), Frames{frame}) << cut;
  }
  EXPECT_EQ(push(joined({kRead, rtu_frame(3, {4, 2, 0, 0}), kRead}), kPause),
            (Frames{kRead, kRead}));
  EXPECT_EQ(framer_.errors(), 0U);
}

TEST_F(RtuFramerTest, WhatIsForOthersIsPassedOver) {
  EXPECT_EQ(push(rtu_frame(3, {4, 0, 0, 0, 1}), kPause), Frames{});
  EXPECT_EQ(push(rtu_frame(3, {4, 2, 0, 0}), kPause), Frames{});  // its answer
  EXPECT_EQ(push(kRead, kPause), Frames{kRead});
  EXPECT_EQ(framer_.other_units(), 2U);
  EXPECT_EQ(framer_.errors(), 0U);
}

TEST_F(RtuFramerTest, AWrongChecksumIsNoFrameAndCostsNoOther) {
  for (std::size_t i = 0; i < kRead.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      Bytes damaged = kRead;
      damaged[i] ^= static_cast<std::uint8_t>(1 << bit);
      EXPECT_EQ(push(damaged, kLong), Frames{});
      EXPECT_EQ(push(kRead, kLong), Frames{kRead}) << i;
    }
  }
  EXPECT_EQ(framer_.errors(), 8 * kRead.size());
}

TEST_F(RtuFramerTest, AfterNoiseAPauseIsEnough) {
  // A driver that switches off causes such a byte.
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(push({static_cast<std::uint8_t>(byte)}, kPause), Frames{});
    EXPECT_EQ(push(kRead, kPause), Frames{kRead}) << byte;
  }
  EXPECT_EQ(framer_.errors(), 256U);
}

TEST_F(RtuFramerTest, HalfAFrameIsForgottenInTime) {
  EXPECT_EQ(push(Bytes(kRead.begin(), kRead.begin() + 5), kPause), Frames{});
  EXPECT_EQ(push(Bytes(kRead.begin() + 5, kRead.end()), kLong), Frames{});
  EXPECT_EQ(push(kRead, kLong), Frames{kRead});
}

TEST_F(RtuFramerTest, AFrameThatSaysItIsTooLongIsNone) {
  Bytes pdu{16, 0, 0, 0, 124, 248};
  pdu.resize(6 + 248);
  const Bytes frame = rtu_frame(kUnit, pdu);  // 257 bytes
  EXPECT_EQ(push(Bytes(frame.begin(), frame.begin() + 200), kPause), Frames{});
  EXPECT_EQ(push(Bytes(frame.begin() + 200, frame.end()), kNone), Frames{});
  EXPECT_EQ(framer_.errors(), 1U);
  EXPECT_EQ(push(kRead, kPause), Frames{kRead});
}

TEST_F(RtuFramerTest, FromNoiseNoFrameIsMadeAndAfterItTheNextIsFound) {
  std::mt19937 random(20240602);
  int made = 0;
  const int cases = orbwatch::tests::share_of(20000);
  for (int i = 0; i < cases; ++i) {
    Bytes noise(1 + random() % RtuFramer::kLongestFrame);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    if (random() % 2) noise[0] = kUnit;
    made += static_cast<int>(push(noise, random() % 2 ? kNone : kPause).size());
    if (i % 4 == 0) {
      ASSERT_EQ(push(kRead, kLong), Frames{kRead});
    }
  }
  // By chance one in 65536 of those with our unit has a valid checksum, at each of several places.
  EXPECT_LT(made, cases / 200);
  EXPECT_GT(framer_.errors(), static_cast<unsigned>(cases / 2));
}

const Bytes kWriteRequest = rtu_frame(kUnit, {16, 0, 0, 0, 2, 4, 0, 9, 0, 8});
const Bytes kReadIdentity = rtu_frame(kUnit, {43, 14, 1, 0});
const Bytes kUnknownRequest = rtu_frame(kUnit, {100, 1, 2, 3});

TEST_F(RtuFramerTest, StrayBytesInFrontOfARequestDoNotCostIt) {
  for (const Bytes& request : {kRead, kWriteRequest, kReadIdentity, kUnknownRequest}) {
    for (int byte = 0; byte < 256; ++byte) {
      const auto stray = static_cast<std::uint8_t>(byte);
      EXPECT_EQ(push_last(joined({{stray}, request})), Frames{request}) << byte;
      EXPECT_EQ(push_last(joined({{stray, stray, 0xff}, request})), Frames{request}) << byte;
      EXPECT_EQ(push_last(joined({{stray}, request, {stray}})), Frames{request}) << byte;
    }
  }
}

TEST_F(RtuFramerTest, EachStrayBeginningIsOneError) {
  push_last(joined({{3}, kRead}));
  EXPECT_EQ(framer_.errors(), 1U);
  push_last(joined({{kUnit}, kRead}));
  EXPECT_EQ(framer_.errors(), 2U);
  push_last({1, 2, 3});
  EXPECT_EQ(framer_.errors(), 3U);
  push_last(kRead);
  EXPECT_EQ(framer_.errors(), 3U);
}

TEST_F(RtuFramerTest, ARequestBehindHalfOfAnotherOneIsFound) {
  for (const Bytes& broken : {kRead, kWriteRequest, rtu_frame(3, {4, 0, 0, 0, 1})}) {
    for (std::size_t cut = 1; cut < broken.size(); ++cut) {
      const Bytes half(broken.begin(), broken.begin() + static_cast<std::ptrdiff_t>(cut));
      EXPECT_EQ(push_last(joined({half, kWriteRequest})), Frames{kWriteRequest}) << cut;
    }
  }
}

TEST_F(RtuFramerTest, ARequestBehindMuchNoiseIsFoundWhereverAdaptersCutIt) {
  std::mt19937 random(20240605);
  constexpr int kLines = 200;
  int found = 0;
  for (int i = 0; i < kLines; ++i) {
    Bytes line(1 + random() % (3 * RtuFramer::kLongestFrame));
    for (auto& byte : line) byte = static_cast<std::uint8_t>(random());
    line.insert(line.end(), kRead.begin(), kRead.end());
    std::vector<Bytes> frames;
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t size =
          std::min(line.size() - at, std::size_t{1 + random() % RtuFramer::kLongestFrame});
      const auto begin = line.begin() + static_cast<std::ptrdiff_t>(at);
      const auto got = push(Bytes(begin, begin + static_cast<std::ptrdiff_t>(size)),
                            at == 0             ? kLong
                            : random() % 4 == 0 ? kPause
                                                : kNone);
      frames.insert(frames.end(), got.begin(), got.end());
      at += size;
    }
    if (framer_.is_waiting()) framer_.end();
    while (const auto frame = framer_.next()) frames.emplace_back(frame->begin(), frame->end());
    found += !frames.empty() && frames.back() == kRead ? 1 : 0;
  }
  // By chance one in 65536 of the longer endings also has a valid checksum.
  EXPECT_GE(found, kLines - 4);
}

TEST_F(RtuFramerTest, ARequestInsideAnotherUnitsFrameIsNotAnswered) {
  Bytes pdu{16, 0, 0, 0, 4, 8};
  pdu.insert(pdu.end(), kRead.begin(), kRead.end());
  const Bytes other = rtu_frame(3, pdu);
  EXPECT_EQ(push_last(other), Frames{});
  EXPECT_EQ(push_last(joined({{0xff}, other})), Frames{}) << "behind a stray byte";
  EXPECT_EQ(push_last(joined({{kUnit}, other})), Frames{});
  Bytes damaged = other;
  damaged[3] ^= 1;
  EXPECT_EQ(push_last(damaged), Frames{});
  EXPECT_EQ(push_last(joined({{0xff}, rtu_frame(3, {4, 0, 0, 0, 1})})), Frames{});
  // Cut anywhere, with pauses like those of adapters except before the inner frame.
  for (std::size_t at = 1; at < other.size(); ++at) {
    const auto middle = other.begin() + static_cast<std::ptrdiff_t>(at);
    EXPECT_EQ(push(joined({{0xff}, Bytes(other.begin(), middle)}), kLong), Frames{}) << at;
    EXPECT_EQ(push(Bytes(middle, other.end()), kNone), Frames{}) << at;
    framer_.end();
    EXPECT_FALSE(framer_.next()) << at;
  }
}

/// Bytes in front of a frame that do not change its checksum.
Bytes neutral_bytes() {
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const Bytes bytes{static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(second)};
      Bytes frame = joined({bytes, kRead});
      const Bytes checked = rtu_frame(bytes[0], Bytes(frame.begin() + 1, frame.end() - 2));
      if (checked == frame) return bytes;
    }
  }
  return {};
}

TEST_F(RtuFramerTest, AnotherUnitsFrameThatEndsLikeARequestIsNotAnswered) {
  const Bytes bytes = neutral_bytes();
  ASSERT_EQ(bytes.size(), 2U);
  ASSERT_NE(bytes[0], kUnit);
  EXPECT_EQ(push_last(joined({bytes, kRead})), Frames{});
  EXPECT_EQ(push_last(joined({{0xff}, bytes, kRead})), Frames{});
}

}  // namespace
}  // namespace orbwatch::app::modbus
