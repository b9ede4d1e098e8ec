// What other DDS implementations see of the topics: names, types, QoS and the bytes of a sample.
#include <dds/ddsi/ddsi_serdata.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "app/dds/dds_sink.h"
#include "tests/app/dds/dds_network.h"
#include "tests/app/dds/test_status.h"
#include "tests/app/dds/test_views.h"
#include "tests/app/dds/topic_reader.h"

namespace orbwatch::app {
namespace {

using tests::eventually;
using tests::make_view;
using Bytes = std::vector<std::uint8_t>;

/// Plain CDR, version 1, little-endian (DDSI-RTPS 2.5, 10.2; OMG CORBA 3.3 part 2, 9.3), written
/// down by hand: every number at a multiple of its size, strings with their terminating zero.
class Cdr {
 public:
  template <class T>
  Cdr& number(T value) {
    bytes_.resize((bytes_.size() + sizeof(T) - 1) / sizeof(T) * sizeof(T));
    std::array<std::uint8_t, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if (std::endian::native == std::endian::big) std::ranges::reverse(raw);
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
    return *this;
  }
  Cdr& text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size() + 1));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    bytes_.push_back(0);
    return *this;
  }
  Cdr& blob(const Bytes& value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    return *this;
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

struct Sample {
  Bytes header;   ///< encapsulation: representation and options
  Bytes payload;  ///< without the padding that the options tell of
};

/// The next sample as it came from the network, if one is there.
template <class Message>
bool take_bytes(const tests::TopicReader<Message>& reader, Sample& sample) {
  if (!reader.wait()) return false;
  ddsi_serdata* serialized = nullptr;
  dds_sample_info_t info{};
  if (dds_takecdr(reader.get(), &serialized, 1, &info, DDS_ANY_STATE) != 1) return false;
  Bytes all(ddsi_serdata_size(serialized));
  ddsi_serdata_to_ser(serialized, 0, all.size(), all.data());
  ddsi_serdata_unref(serialized);
  EXPECT_GE(all.size(), 4u);
  const std::size_t padding = all[3] & 3;
  sample.header = {all[0], all[1]};
  sample.payload = Bytes(all.begin() + 4, all.end() - static_cast<std::ptrdiff_t>(padding));
  return true;
}

struct Announcement {
  std::string topic;
  std::string type;
  std::string user_data;
  dds_reliability_kind_t reliability{};
  dds_duration_t max_blocking_time = 0;
  dds_durability_kind_t durability{};
  dds_history_kind_t history{};
  std::int32_t depth = 0;
  std::vector<dds_data_representation_id_t> representations;
};

/// What the writer that `reader` matches told the network about itself.
bool announcement(dds_entity_t reader, Announcement& told) {
  dds_instance_handle_t writer = 0;
  if (dds_get_matched_publications(reader, &writer, 1) < 1) return false;
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader, writer);
  if (endpoint == nullptr) return false;
  told.topic = endpoint->topic_name;
  told.type = endpoint->type_name;
  void* data = nullptr;
  std::size_t size = 0;
  if (dds_qget_userdata(endpoint->qos, &data, &size)) {
    told.user_data.assign(static_cast<const char*>(data), size);
    dds_free(data);
  }
  dds_qget_reliability(endpoint->qos, &told.reliability, &told.max_blocking_time);
  dds_qget_durability(endpoint->qos, &told.durability);
  dds_qget_history(endpoint->qos, &told.history, &told.depth);
  std::uint32_t count = 0;
  dds_data_representation_id_t* values = nullptr;
  if (dds_qget_data_representation(endpoint->qos, &count, &values)) {
    told.representations.assign(values, values + count);
    dds_free(values);
  }
  dds_builtintopic_free_endpoint(endpoint);
  return true;
}

class WireFormatTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(network_.valid());
    ASSERT_TRUE(sink_.start());
  }

  tests::DdsNetwork network_;
  DdsSink sink_{{.enabled = true, .domain = tests::DdsNetwork::kSinkDomain, .prefix = "orbwatch"},
                {"front"}};
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

TEST_F(WireFormatTest, StateIsPlainCdr) {
  Status status = tests::make_status();
  status.frame_set = 0;  // no stamp
  status.view_count = 1;
  sink_.accept(status);
  Sample sample;
  ASSERT_TRUE(eventually([&] { return take_bytes(states_, sample); }));
  EXPECT_EQ(sample.header, (Bytes{0, 1})) << "CDR_LE";
  Cdr expected;
  expected.number<std::int32_t>(0).number<std::uint32_t>(0).number<std::uint64_t>(0);
  expected.number(status.trigger);
  expected.number<std::uint8_t>(2).number(status.heartbeat).number<std::uint32_t>(1);
  expected.number(status.process_inputs);
  expected.number(status.overruns).number(status.unmatched).number(status.skew_ms);
  expected.number(status.load);
  for (const auto& signal : signals::kSignals) expected.number(status.signals.*signal.member);
  expected.number<std::uint32_t>(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& camera = status.cameras[i];
    expected.number<std::uint8_t>(2).number(camera.frames).number(camera.lost);
    expected.number(camera.dropped).number(camera.frames_per_second);
    expected.number(camera.latency_p50_ms).number(camera.latency_p99_ms);
    expected.number(camera.triggers).number(camera.missed).number(camera.unmatched);
  }
  const auto& view = status.views[0];
  expected.number<std::uint32_t>(1).text("front").number(view.published).number(view.skipped);
  expected.number(view.frames_per_second).number(view.latency_p50_ms).number(view.latency_p99_ms);
  EXPECT_EQ(sample.payload, expected.bytes());
}

}  // namespace
}  // namespace orbwatch::app
