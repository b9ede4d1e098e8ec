// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/echo_filter.h"

#include <gtest/gtest.h>

#include "tests/app/ports/modbus/clients.h"

namespace orbwatch::app::modbus {
namespace {

using std::chrono::milliseconds;
using tests::Bytes;
using tests::rtu_frame;

const Bytes kReadRequest = rtu_frame(1, {4, 0, 0, 0, 1});
const Bytes kEchoedRead = rtu_frame(1, {4, 2, 0, 3});
const Bytes kEchoedWrite = rtu_frame(1, {6, 0, 10, 0, 5});  // the answer is identical
const Bytes kNothing;

Bytes one_line(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// A line with a clock that only the test advances.
class EchoFilterTest : public testing::Test {
 protected:
  /// A request arrives and is answered.
  void answer(const Bytes& bytes, bool is_request) {
    filter_.end_wait();
    filter_.expect(bytes, is_request, now_);
  }
  void answer_read() { answer(kEchoedRead, false); }
  void answer_write() { answer(kEchoedWrite, true); }
  Bytes strip(const Bytes& bytes) {
    const auto passed = filter_.strip(bytes, now_);
    return {passed.begin(), passed.end()};
  }

  hal::TimePoint now_ = hal::TimePoint{} + std::chrono::hours(5);
  EchoFilter filter_{19200};
};

TEST_F(EchoFilterTest, WithoutAnAnswerEverythingPasses) {
  EXPECT_EQ(strip(kReadRequest), kReadRequest);
  EXPECT_EQ(strip(kEchoedWrite), kEchoedWrite);
  EXPECT_EQ(filter_.echoes(), 0U);
}

TEST_F(EchoFilterTest, TheAnswerThatComesBackIsDropped) {
  answer_read();
  EXPECT_EQ(strip(kEchoedRead), kNothing);
  answer_write();
  EXPECT_EQ(strip(kEchoedWrite), kNothing);
  EXPECT_EQ(filter_.echoes(), 2U);
  EXPECT_EQ(strip(kEchoedWrite), kEchoedWrite) << "each answer comes back once";
}

TEST_F(EchoFilterTest, AnywhereCutAndGluedToTheNextRequest) {
  for (const Bytes& next : {kReadRequest, kEchoedWrite}) {
    const Bytes line = one_line({kEchoedWrite, next});
    for (std::size_t cut = 1; cut < line.size(); ++cut) {
      answer_write();
      const auto at = line.begin() + static_cast<std::ptrdiff_t>(cut);
      const Bytes first = strip(Bytes(line.begin(), at));
      now_ += milliseconds(20);
      EXPECT_EQ(one_line({first, strip(Bytes(at, line.end()))}), next) << cut;
    }
  }
}

TEST_F(EchoFilterTest, BehindAStrayByte) {
  answer_write();
  EXPECT_EQ(strip(one_line({{0xff, 1}, kEchoedWrite})), (Bytes{0xff, 1}));
  EXPECT_EQ(filter_.echoes(), 1U);
}

TEST_F(EchoFilterTest, OfEachOfSeveralAnswers) {
  filter_.expect(kEchoedWrite, true, now_);
  filter_.expect(kEchoedRead, false, now_);
  filter_.expect(kEchoedWrite, true, now_);
  EXPECT_EQ(strip(one_line({kEchoedWrite, kEchoedRead, kEchoedWrite, kReadRequest})), kReadRequest);
  EXPECT_EQ(filter_.echoes(), 3U);
}

TEST_F(EchoFilterTest, ARepetitionThatComesLaterPasses) {
  answer_write();
  now_ = filter_.deadline();
  EXPECT_EQ(strip(kEchoedWrite), kEchoedWrite);
  EXPECT_EQ(filter_.echoes(), 0U);
}

TEST_F(EchoFilterTest, IsExpectedUntilTheLineWasSilentAtItsDeadline) {
  EXPECT_FALSE(filter_.is_waiting());
  answer_write();
  EXPECT_TRUE(filter_.is_waiting());
  now_ = filter_.deadline();
  EXPECT_EQ(strip(kNothing), kNothing);
  EXPECT_FALSE(filter_.is_waiting());
}

TEST_F(EchoFilterTest, TheTimeOfTheAnswerOnTheLineCounts) {
  EchoFilter slow(1200);
  slow.expect(kEchoedWrite, true, now_);
  filter_.expect(kEchoedWrite, true, now_);
  EXPECT_GE(slow.deadline() - filter_.deadline(), milliseconds(60));
}

TEST_F(EchoFilterTest, PartOfAnEchoIsReturnedInTime) {
  answer_write();
  const Bytes part(kEchoedWrite.begin(), kEchoedWrite.begin() + 5);
  EXPECT_EQ(strip(part), kNothing);
  EXPECT_TRUE(filter_.is_waiting());
  now_ = filter_.deadline();
  EXPECT_EQ(strip({}), part);
  EXPECT_FALSE(filter_.is_waiting());
}

TEST_F(EchoFilterTest, OnALineWithoutAnEchoARepetitionAtOncePasses) {
  answer_read();
  EXPECT_EQ(strip(kEchoedWrite), kEchoedWrite) << "no echo of the read";
  answer_write();
  EXPECT_EQ(strip(kEchoedWrite), kEchoedWrite);
  answer_write();
  EXPECT_EQ(strip(kReadRequest), kReadRequest);
  EXPECT_EQ(filter_.echoes(), 0U);
}

TEST_F(EchoFilterTest, AnEchoThatBeginsLaterIsNotAnsweredForEver) {
  answer_read();
  int answered = 0;
  for (Bytes line = kEchoedWrite; !line.empty() && answered < 100; ++answered) {
    line = strip(line);
    if (!line.empty()) answer_write();
  }
  EXPECT_LT(answered, 10);
  answer_write();
  EXPECT_EQ(strip(kEchoedWrite), kNothing);
}

}  // namespace
}  // namespace orbwatch::app::modbus
