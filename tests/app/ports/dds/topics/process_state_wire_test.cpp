// SPDX-License-Identifier: Apache-2.0
// Topics on the wire: names, types, QoS and the bytes of a sample.
#include <gtest/gtest.h>

#include <cstring>

#include "app/ports/dds/dds_sink.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"
#include "tests/app/ports/dds/topic_reader.h"
#include "tests/app/ports/dds/wire.h"

namespace orbwatch::app::dds {
namespace {

using tests::announcement;
using tests::Announcement;
using tests::Bytes;
using tests::Cdr;
using tests::eventually;
using tests::make_view;
using tests::Sample;
using tests::take_bytes;

class WireFormatTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(network_.valid());
    ASSERT_TRUE(sink_.start());
  }

  tests::DdsNetwork network_;
  DdsSink sink_{{.domain = tests::DdsNetwork::kSinkDomain}, tests::make_names(), nullptr};
  tests::TopicReader<ImageMessage> images_{sensor_msgs_msg_dds__Image__desc,
                                           "rt/orbwatch/front/image_raw", frame_qos()};
  tests::TopicReader<ProcessStateMessage> states_{orbwatch_msgs_msg_dds__ProcessState__desc,
                                                  "rt/orbwatch/process_state", state_qos()};
};

TEST_F(WireFormatTest, ImageIsAnnouncedAsRos2Does) {
  Announcement told;
  ASSERT_TRUE(eventually([&] { return announcement(images_.get(), told); }));
  EXPECT_EQ(told.topic, "rt/orbwatch/front/image_raw");
  EXPECT_EQ(told.type, "sensor_msgs::msg::dds_::Image_");
  EXPECT_EQ(told.user_data,
            "typehash=RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47;");
  EXPECT_EQ(told.reliability, DDS_RELIABILITY_RELIABLE);
  EXPECT_EQ(told.max_blocking_time, DDS_MSECS(100));
  EXPECT_EQ(told.durability, DDS_DURABILITY_VOLATILE);
  ASSERT_FALSE(told.representations.empty());
  EXPECT_EQ(told.representations[0], DDS_DATA_REPRESENTATION_XCDR1);
}

TEST_F(WireFormatTest, StateIsAnnouncedAsRos2Does) {
  Announcement told;
  ASSERT_TRUE(eventually([&] { return announcement(states_.get(), told); }));
  EXPECT_EQ(told.topic, "rt/orbwatch/process_state");
  EXPECT_EQ(told.type, "orbwatch_msgs::msg::dds_::ProcessState_");
  EXPECT_EQ(told.reliability, DDS_RELIABILITY_RELIABLE);
  EXPECT_EQ(told.durability, DDS_DURABILITY_TRANSIENT_LOCAL);
  ASSERT_FALSE(told.representations.empty());
  EXPECT_EQ(told.representations[0], DDS_DATA_REPRESENTATION_XCDR1);
}

TEST_F(WireFormatTest, ImageIsPlainCdr) {
  const auto view = make_view(0, "front", 1, 7, 3);
  Sample sample;
  ASSERT_TRUE(eventually([&] {
    tests::hand_over(sink_, view);
    return take_bytes(images_, sample);
  }));
  EXPECT_EQ(sample.header, (Bytes{0, 1})) << "CDR_LE";
  ASSERT_GE(sample.payload.size(), 8u);
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::memcpy(&sec, sample.payload.data(), 4);
  std::memcpy(&nanosec, sample.payload.data() + 4, 4);
  EXPECT_LT(nanosec, 1'000'000'000u);
  Cdr expected;
  expected.number(sec).number(nanosec).text("front");
  expected.number<std::uint32_t>(3).number<std::uint32_t>(7).text("rgb8");
  expected.number<std::uint8_t>(0).number<std::uint32_t>(21).blob(
      {view->bytes.begin(), view->bytes.end()});
  EXPECT_EQ(sample.payload, expected.bytes());
}

/// Appends a component up to its figures.
Cdr& component(Cdr& cdr, std::string_view kind, std::string_view name, std::uint32_t figures) {
  return cdr.text(kind).text(name).number(figures);
}

Cdr& figure(Cdr& cdr, std::string_view name, double value, std::string_view unit = "",
            std::string_view text = "") {
  return cdr.text(name).number(value).text(unit).text(text);
}

TEST_F(WireFormatTest, StateIsPlainCdr) {
  Status status = tests::make_status();
  status.frame_set = 0;  // no stamp
  status.region_count = status.alarm_count = status.camera_count = status.view_count = 1;
  // Unset, because ages increase.
  status.stamp = status.cameras[0].last_frame = status.alarms[0].since = {};
  sink_.accept(status);
  Sample sample;
  ASSERT_TRUE(eventually([&] { return take_bytes(states_, sample); }));
  EXPECT_EQ(sample.header, (Bytes{0, 1})) << "CDR_LE";
  Cdr expected;
  expected.number<std::int32_t>(0).number<std::uint32_t>(0).text("").number<std::uint64_t>(0);
  expected.number(status.trigger).number(status.result).number(tests::kRecipe);
  expected.number<std::uint32_t>(0xdeadbeef).number<std::uint8_t>(2).number(status.heartbeat);
  expected.number<std::uint32_t>(7 + kStages);
  const StatusNames names = tests::make_names();
  for (const auto& [part, readings] : status_readings({status, names, {}, {}})) {
    component(expected, part.kind, part.name, static_cast<std::uint32_t>(readings.size()));
    for (const auto& r : readings) figure(expected, r.name, r.value, r.unit, r.text);
  }
  component(expected, "commands", "", 4);
  for (const auto* name : {"done", "refused", "repeated", "dropped"}) figure(expected, name, 0);
  EXPECT_EQ(sample.payload, expected.bytes());
}

TEST_F(WireFormatTest, EventIsPlainCdr) {
  const tests::TopicReader<EventMessage> events(orbwatch_msgs_msg_dds__Event__desc,
                                                "rt/orbwatch/event", event_qos());
  AlarmNotice notice;
  notice.number = 3;
  notice.event = {0,
                  signals::AlarmEventKind::Raised,
                  signals::AlarmState::Unacknowledged,
                  signals::AlarmLevel::HighAlarm,
                  1.5,
                  {}};
  notice.recipe = tests::kRecipe;
  notice.frame_set = 9;
  sink_.accept_event(notice);
  Sample sample;
  ASSERT_TRUE(eventually([&] { return take_bytes(events, sample); }));
  ASSERT_GE(sample.payload.size(), 8u);
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::memcpy(&sec, sample.payload.data(), 4);
  std::memcpy(&nanosec, sample.payload.data() + 4, 4);
  const std::string signal(signals::kSignals[0].name);
  const std::string_view unit = signals::kSignals[0].unit;
  Cdr expected;
  expected.number(sec).number(nanosec).text("").number<std::uint64_t>(3).text("alarm");
  expected.text("1, weld: " + signal).number<std::uint8_t>(2);
  expected.text("weld: " + signal + " raised, high alarm, 1.5" +
                (unit.empty() ? "" : " " + std::string(unit)));
  expected.number<std::uint32_t>(11);
  figure(expected, "alarm", 1);
  figure(expected, "event", 0, "", "raised");
  figure(expected, "state", 1, "", "in alarm, not acknowledged");
  figure(expected, "level", 4, "", "high alarm");
  figure(expected, "value", 1.5, unit);
  figure(expected, "signal", 0, "", signal);
  figure(expected, "region", 0, "", "weld");
  figure(expected, "recipe", tests::kRecipe);
  figure(expected, "frame_set", 9);
  figure(expected, "part", signals::kNotValid);
  figure(expected, "layer", signals::kNotValid);
  EXPECT_EQ(sample.payload, expected.bytes());
}

}  // namespace
}  // namespace orbwatch::app::dds
