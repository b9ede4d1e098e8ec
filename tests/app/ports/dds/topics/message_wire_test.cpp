// SPDX-License-Identifier: Apache-2.0
// Compares the bytes of the messages of ROS 2 with those required by its definitions.
#include <gtest/gtest.h>

#include "app/ports/dds/generated/compressed_image.h"
#include "app/ports/dds/pictures/camera_info.h"
#include "app/ports/dds/status/diagnostics.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/topic_reader.h"
#include "tests/app/ports/dds/wire.h"

namespace orbwatch::app::dds {
namespace {

using tests::Bytes;
using tests::Cdr;
using tests::eventually;

class MessageWire : public testing::Test {
 protected:
  /// Data on the network when `message` is written.
  template <class Message>
  Bytes sent(const dds_topic_descriptor_t& type, const Message& message) {
    EXPECT_TRUE(network_.valid());
    const tests::TopicReader<Message> reader(type, "rt/message", state_qos());
    const auto participant = Participant::join(tests::DdsNetwork::kSinkDomain).value();
    const Entity topic = make_topic(participant.entity(), type, "rt/message").value();
    const Entity writer = make_writer(participant.entity(), topic, state_qos()).value();
    EXPECT_EQ(dds_write(writer.get(), &message), DDS_RETCODE_OK);
    tests::Sample sample;
    EXPECT_TRUE(eventually([&] { return tests::take_bytes(reader, sample); }));
    EXPECT_EQ(sample.header, (Bytes{0, 1})) << "CDR_LE";
    tests::Announcement told;
    EXPECT_TRUE(tests::announcement(reader.get(), told));
    type_ = told.type;
    EXPECT_EQ(told.representations.front(), DDS_DATA_REPRESENTATION_XCDR1);
    return sample.payload;
  }

  tests::DdsNetwork network_;
  std::string type_;  ///< announced type name
  std::string frame_ = "front";
};

Cdr header(const std::string& frame) {
  Cdr cdr;
  cdr.number<std::int32_t>(17).number<std::uint32_t>(18).text(frame);
  return cdr;
}

TEST_F(MessageWire, CompressedImage) {
  Bytes jpeg{0xff, 0xd8, 0xff};
  std::string format = "rgb8; jpeg compressed bgr8";
  sensor_msgs_msg_dds__CompressedImage_ message{};
  message.header = {{17, 18}, frame_.data()};
  message.format = format.data();
  message.data = {3, 3, jpeg.data(), false};
  Cdr expected = header(frame_);
  expected.text(format).blob(jpeg);
  EXPECT_EQ(sent(sensor_msgs_msg_dds__CompressedImage__desc, message), expected.bytes());
  EXPECT_EQ(type_, "sensor_msgs::msg::dds_::CompressedImage_");
}

TEST_F(MessageWire, CameraInfo) {
  const auto lens = lens_of({optics::ViewKind::Perspective, {}, 90.0, {}, 640, 480}).value();
  CameraInfoMessage info = camera_info(lens, frame_, {17, 18});
  info.binning_x = 1;
  info.binning_y = 2;
  info.roi = {3, 4, 5, 6, true};
  Cdr expected = header(frame_);
  expected.number<std::uint32_t>(480).number<std::uint32_t>(640).text("plumb_bob");
  expected.number<std::uint32_t>(5);
  for (int i = 0; i < 5; ++i) expected.number(0.0);
  for (const double value : info.k) expected.number(value);
  for (const double value : info.r) expected.number(value);
  for (const double value : info.p) expected.number(value);
  for (std::uint32_t value = 1; value <= 6; ++value) expected.number(value);
  expected.number<std::uint8_t>(1);
  EXPECT_EQ(sent(sensor_msgs_msg_dds__CameraInfo__desc, info), expected.bytes());
  EXPECT_EQ(type_, "sensor_msgs::msg::dds_::CameraInfo_");
}

TEST_F(MessageWire, DiagnosticArray) {
  DiagnosticsComposer composer("cell-7");
  const DiagnosticsMessage& message =
      composer.compose({{DiagnosticLevel::Error, "orbwatch: a", "broken", {{"k", "v"}, {"l", ""}}},
                        {DiagnosticLevel::Stale, "orbwatch: b", "", {}}},
                       {17, 18});
  Cdr expected = header("");
  expected.number<std::uint32_t>(2);
  expected.number<std::uint8_t>(2).text("orbwatch: a").text("broken").text("cell-7");
  expected.number<std::uint32_t>(2).text("k").text("v").text("l").text("");
  expected.number<std::uint8_t>(3).text("orbwatch: b").text("").text("cell-7");
  expected.number<std::uint32_t>(0);
  EXPECT_EQ(sent(diagnostic_msgs_msg_dds__DiagnosticArray__desc, message), expected.bytes());
  EXPECT_EQ(type_, "diagnostic_msgs::msg::dds_::DiagnosticArray_");
}

}  // namespace
}  // namespace orbwatch::app::dds
