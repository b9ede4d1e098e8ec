// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/status/status_topics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/status/status_queue.h"
#include "app/ports/dds/topics/topic_names.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/topic_reader.h"

namespace orbwatch::app::dds {
namespace {

using testing::ElementsAre;
using tests::DdsNetwork;
using tests::eventually;

/// QoS of a reader of every result.
Qos deep_qos() {
  Qos qos = state_qos();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 100);
  return qos;
}

class ResultReader : public tests::TopicReader<ProcessStateMessage> {
 public:
  ResultReader()
      : TopicReader(orbwatch_msgs_msg_dds__ProcessState__desc, process_state_topic("orbwatch"),
                    deep_qos()) {}

  /// Takes states until that of result `last`; returns their results.
  std::vector<std::uint64_t> take_until(std::uint64_t last) const {
    std::vector<std::uint64_t> results;
    EXPECT_TRUE(eventually([&] {
      take([&](const ProcessStateMessage& state) { results.push_back(state.result); });
      return !results.empty() && results.back() == last;
    }));
    return results;
  }
};

class StatusTopicsTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(network_.valid());
    const auto opened = topics_.open(participant_.entity());
    ASSERT_TRUE(opened) << opened.error().message;
  }
  void publish(std::uint64_t result) {
    StampedStatus stamped{};
    stamped.status.result = result;
    topics_.publish(stamped, {}, [] { return DdsStatistics{}; });
  }

  const DdsNetwork network_;
  Participant participant_ = Participant::join(DdsNetwork::kSinkDomain).value();
  StatusTopics topics_{"orbwatch", tests::make_names()};
};

TEST_F(StatusTopicsTest, ALateReaderGetsTheNewestStateOnly) {
  for (const std::uint64_t result : {1, 2, 3}) publish(result);
  const ResultReader late;
  EXPECT_THAT(late.take_until(3), ElementsAre(3));
  publish(4);
  EXPECT_THAT(late.take_until(4), ElementsAre(4));
}

TEST_F(StatusTopicsTest, ResultsThatAReaderLostAreSentAgain) {
  publish(1);
  const ResultReader reader;
  ASSERT_THAT(reader.take_until(1), ElementsAre(1));
  network_.hang_readers(true);
  std::vector<std::uint64_t> lost;
  for (std::uint64_t n = 0; n < StatusQueue::kMaxResults; ++n) lost.push_back(2 + n);
  for (const std::uint64_t result : lost) publish(result);
  EXPECT_FALSE(reader.wait()) << "the readers were not hung";
  network_.hang_readers(false);
  EXPECT_EQ(reader.take_until(lost.back()), lost);
}

}  // namespace
}  // namespace orbwatch::app::dds
