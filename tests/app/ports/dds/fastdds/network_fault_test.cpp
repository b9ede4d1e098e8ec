// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>

#include "app/ports/dds/dds_sink.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/fastdds/paced_views.h"
#include "tests/app/ports/dds/fastdds/reader_program.h"
#include "tests/app/ports/dds/fastdds/shipped_network.h"
#include "tests/support/sanitizers.h"

/// Failures of readers and cables: pictures reach the remaining readers, the pipeline never waits,
/// every picture is accounted for and memory does not grow.
namespace orbwatch::app::dds {
namespace {

using orbwatch::tests::foreign_reader;
using orbwatch::tests::parsed;
using orbwatch::tests::ReaderProgram;
using tests::eventually;
using tests::ShippedNetwork;

const std::string kTopic = "rt/orbwatch/front/image_raw";

/// Resident memory of this process, bytes.
std::int64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::int64_t all = 0;
  std::int64_t resident = 0;
  file >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

class NetworkFault : public testing::Test {
 protected:
  void SetUp() override {
    ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
    network_.emplace(ShippedNetwork::Kind::Lan);
    network_->start(sink_);
  }

  std::unique_ptr<ReaderProgram> reader(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"--topic", kTopic, "--type", "image"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<ReaderProgram>(network_->readers(),
                                           foreign_reader(tests::kDomain, arguments));
  }

  /// Passes views until `reader` has received `count` more of them.
  bool gets_more(const ReaderProgram& reader, std::size_t count = 5) {
    const auto before = reader.samples().size();
    return eventually([&] {
      views_.hand_over();
      return reader.samples().size() >= before + count;
    });
  }

  /// Expects that the pipeline did not wait, and that each view was written, or dropped with a
  /// counted reason.
  void expect_accounted() {
    if (!orbwatch::tests::kIsSanitized) {
      // The thread that briefly holds a topic's lock may occasionally be preempted at that moment.
      EXPECT_LE(views_.waits(), views_.accepted() / 20) << "of " << views_.accepted();
    }
    ASSERT_TRUE(eventually([&] { return views_.all_returned(); }));
    const auto statistics = sink_.statistics();
    const auto topic = std::ranges::find(statistics.topics, kTopic, &TopicStatistics::topic);
    ASSERT_NE(topic, statistics.topics.end());
    EXPECT_EQ(topic->written + topic->unread + topic->replaced + topic->limited + topic->blocked +
                  topic->failed,
              views_.accepted());
  }

  std::optional<ShippedNetwork> network_;
  DdsSink sink_{{.domain = tests::kDomain}, tests::make_names(), nullptr};
  // Small enough for the system's default receive buffer.
  tests::PacedViews views_{
      sink_,
      {tests::make_view(0, "front", 1, 160, 90), tests::make_view(0, "front", 2, 160, 90),
       tests::make_view(0, "front", 3, 160, 90)}};
};

TEST_F(NetworkFault, AStoppedReaderHoldsNobodyUpAndGoesOn) {
  const auto stopped = reader();
  const auto healthy = reader();
  ASSERT_TRUE(gets_more(*stopped)) << stopped->printed();
  ASSERT_TRUE(gets_more(*healthy)) << healthy->printed();
  stopped->program().send(SIGSTOP);
  EXPECT_TRUE(gets_more(*healthy, 30)) << "beside one that is stopped";
  const auto before = resident_bytes();
  EXPECT_TRUE(gets_more(*healthy, 60));
  constexpr std::int64_t kFewPictures = 1 << 20;
  if (!orbwatch::tests::kIsSanitized) {
    EXPECT_LT(resident_bytes() - before, kFewPictures) << "what is kept for the stopped one grows";
  }
  stopped->program().send(SIGCONT);
  EXPECT_TRUE(gets_more(*stopped));
  expect_accounted();
}

TEST_F(NetworkFault, ASlowReaderGetsFewerAndTheOthersAll) {
  const auto slow = reader({"--slow", "300"});
  const auto healthy = reader();
  ASSERT_TRUE(gets_more(*slow, 1)) << slow->printed();
  ASSERT_TRUE(gets_more(*healthy, 1)) << healthy->printed();
  const auto slow_before = slow->samples().size();
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(gets_more(*healthy, 60));
  const auto periods = (std::chrono::steady_clock::now() - begin) / std::chrono::milliseconds(300);
  EXPECT_LE(static_cast<std::int64_t>(slow->samples().size() - slow_before), periods + 2);
  EXPECT_TRUE(gets_more(*slow, 2)) << "it still gets the newest";
  expect_accounted();
}

TEST_F(NetworkFault, AKilledReaderHoldsNobodyUp) {
  const auto killed = reader();
  const auto healthy = reader();
  ASSERT_TRUE(gets_more(*killed)) << killed->printed();
  ASSERT_TRUE(gets_more(*healthy)) << healthy->printed();
  killed->program().send(SIGKILL);
  EXPECT_EQ(killed->program().wait(), -SIGKILL);
  EXPECT_TRUE(gets_more(*healthy, 60));
  expect_accounted();
}

TEST_F(NetworkFault, TenLateReadersAllGetPictures) {
  const auto first = reader();
  ASSERT_TRUE(gets_more(*first)) << first->printed();
  std::vector<std::unique_ptr<ReaderProgram>> late(10);
  for (auto& one : late) one = reader({"--count", "3"});
  EXPECT_TRUE(eventually([&] {
    views_.hand_over();
    return std::ranges::none_of(late, [](const auto& one) { return one->program().runs(); });
  }));
  for (const auto& one : late) EXPECT_EQ(one->program().wait(), 0) << one->printed();
  EXPECT_TRUE(gets_more(*first)) << "who was there before still gets them";
  expect_accounted();
}

TEST_F(NetworkFault, PicturesComeAgainWhenTheCableIsBack) {
  const auto far = reader();
  ASSERT_TRUE(gets_more(*far)) << far->printed();
  network_->cable().pull();
  views_.hand_over(60);
  const auto before = far->samples().size();
  views_.hand_over(10);
  EXPECT_EQ(far->samples().size(), before) << "the cable was not out";
  network_->cable().plug();
  EXPECT_TRUE(gets_more(*far));
  expect_accounted();
}

TEST_F(NetworkFault, PicturesComeAgainUnderAnotherAddress) {
  const auto far = reader();
  ASSERT_TRUE(gets_more(*far)) << far->printed();
  network_->cable().readdress("10.77.0.9");
  ASSERT_TRUE(eventually([&] {
    views_.hand_over();
    return sink_.statistics().joins == 2;
  }));
  EXPECT_TRUE(gets_more(*far));
  expect_accounted();
}

TEST_F(NetworkFault, AnAddressOfAnotherInterfaceInterruptsNobody) {
  std::atomic<int> checks = 0;
  DdsSink counted({.domain = tests::kDomain}, tests::make_names(), nullptr, [&checks] {
    ++checks;
    return network_addresses();
  });
  sink_.stop();
  network_->start(counted);
  const auto checked = [&](int times) {
    const int before = checks;
    return eventually([&] {
      counted.accept(Status{});  // wakes its thread
      return checks >= before + times;
    });
  };
  network_->writers().run([] { orbwatch::tests::ip("addr add 10.88.0.1/24 dev lo"); });
  ASSERT_TRUE(checked(2));
  EXPECT_EQ(counted.statistics().joins, 1U);
  network_->cable().readdress("10.77.0.9");
  EXPECT_TRUE(eventually([&] {
    counted.accept(Status{});
    return counted.statistics().joins == 2;
  }));
}

TEST_F(NetworkFault, ALateReaderGetsTheLastState) {
  const std::vector<std::string> settings{"--topic",          "rt/orbwatch/process_state",
                                          "--type",           "process_state",
                                          "--count",          "1",
                                          "--seconds",        "60",
                                          "--transient-local"};
  sink_.accept(tests::make_status());
  for (int i = 0; i < 3; ++i) {
    ReaderProgram late(network_->readers(), foreign_reader(tests::kDomain, settings));
    EXPECT_EQ(late.program().wait(), 0) << late.printed();
    ASSERT_EQ(late.samples().size(), 1U) << late.printed();
    const auto state = parsed(late.samples().front());
    EXPECT_EQ(static_cast<double>(state["system_state"]), 2);
    const auto system = state["components"][0];
    EXPECT_EQ(system["kind"].string(), "system");
    EXPECT_EQ(system["figures"][0]["name"].string(), "state");
    EXPECT_EQ(system["figures"][0]["text"].string(), operator_text(SystemState::Degraded));
    EXPECT_EQ(state["components"][1]["kind"].string(), "region");
    EXPECT_EQ(state["components"][1]["name"].string(), "weld");
  }
}

}  // namespace
}  // namespace orbwatch::app::dds
