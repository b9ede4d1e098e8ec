// What other DDS implementations see of the topics: names, types, QoS and the bytes of a sample.
#include <gtest/gtest.h>

#include <cstring>

#include "app/dds/dds_sink.h"
#include "tests/app/dds/dds_network.h"
#include "tests/app/dds/test_status.h"
#include "tests/app/dds/test_views.h"
#include "tests/app/dds/topic_reader.h"
#include "tests/app/dds/wire.h"

namespace orbwatch::app {
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
    sink_.accept(view);
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
  expected.number<std::uint8_t>(0).number<std::uint32_t>(21).blob(view->bytes);
  EXPECT_EQ(sample.payload, expected.bytes());
}

Cdr& put(Cdr& cdr, const CameraStatus& camera) {
  cdr.number<std::uint8_t>(2).number(camera.frames).number(camera.lost).number(camera.dropped);
  cdr.number(camera.frames_per_second).number(camera.latency_p50_ms).number(camera.latency_p99_ms);
  return cdr.number(camera.triggers).number(camera.missed).number(camera.unmatched);
}

TEST_F(WireFormatTest, StateIsPlainCdr) {
  Status status = tests::make_status();
  status.frame_set = 0;  // no stamp
  status.region_count = status.alarm_count = status.camera_count = status.view_count = 1;
  status.cameras[0].last_frame = status.alarms[0].since = {};  // no ages, which pass
  sink_.accept(status);
  Sample sample;
  ASSERT_TRUE(eventually([&] { return take_bytes(states_, sample); }));
  EXPECT_EQ(sample.header, (Bytes{0, 1})) << "CDR_LE";
  Cdr expected;
  expected.number<std::int32_t>(0).number<std::uint32_t>(0).number<std::uint64_t>(0);
  expected.number(status.trigger).number(status.result).number(tests::kRecipe);
  expected.number<std::uint32_t>(0xdeadbeef).number<std::uint8_t>(1).number<std::uint8_t>(1);
  expected.number<std::uint8_t>(2).number(status.heartbeat).number<std::uint32_t>(1);
  expected.number(status.process_inputs);
  expected.number(status.overruns).number(status.unmatched).number(status.skew_ms);
  expected.number(status.load);
  const auto put_values = [&expected](const auto& values, const auto& infos) {
    for (const auto& info : infos) expected.number(values.*info.member);
  };
  expected.number<std::uint32_t>(1).text("weld").number<std::uint8_t>(2);
  put_values(status.regions[0].signals, signals::kSignals);
  expected.number<std::uint32_t>(1).number<std::uint32_t>(0).text(signals::kSignals[0].name);
  expected.number<std::uint8_t>(4).number<std::uint8_t>(3).number<std::uint8_t>(4);
  expected.number<std::uint8_t>(1).number(status.alarms[0].value).number(signals::kNotValid);
  expected.number<std::uint32_t>(1).text("colour");
  put(expected, status.cameras[0]).number(signals::kNotValid);
  const auto& view = status.views[0];
  expected.number<std::uint32_t>(1).text("front").number(view.published).number(view.skipped);
  expected.number(view.frames_per_second).number(view.latency_p50_ms).number(view.latency_p99_ms);
  expected.number(view.superseded);
  put_values(status.health, kHealthFigures);
  for (int count = 0; count < 4; ++count) expected.number<std::uint64_t>(0);
  EXPECT_EQ(sample.payload, expected.bytes());
}

}  // namespace
}  // namespace orbwatch::app
