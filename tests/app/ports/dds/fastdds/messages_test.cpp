// SPDX-License-Identifier: Apache-2.0
#include "tests/app/ports/dds/fastdds/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "tests/app/ports/dds/cdr.h"

/// Messages written by hand, octet by octet by DDSI-RTPS 2.5, clause 10.
namespace orbwatch::tests::ros {
namespace {

using app::tests::Bytes;
using WrittenCdr = app::tests::Cdr;

/// The message after its encapsulation (plain, little-endian).
Bytes sent(const WrittenCdr& cdr) {
  constexpr std::size_t kEncapsulation = 4;
  Bytes bytes(kEncapsulation + cdr.bytes().size());
  bytes[1] = 1;
  std::ranges::copy(cdr.bytes(), bytes.begin() + kEncapsulation);
  return bytes;
}

WrittenCdr header(std::int32_t sec, std::uint32_t nanosec, std::string_view frame_id) {
  return WrittenCdr().number(sec).number(nanosec).text(frame_id);
}

std::uint8_t octet(int value) { return static_cast<std::uint8_t>(value); }

template <class Message>
Message decoded(const WrittenCdr& cdr) {
  const auto message = decode<Message>(sent(cdr));
  EXPECT_TRUE(message);
  return message.value_or(Message{});
}

WrittenCdr small_image() {
  return header(7, 9, "front")
      .number(1U)
      .number(2U)
      .text("mono8")
      .number(octet(1))
      .number(2U)
      .blob({200, 100});
}

TEST(RosMessages, Image) {
  const auto image = decoded<Image>(small_image());
  EXPECT_EQ(image.header.stamp, (Time{7, 9}));
  EXPECT_EQ(image.header.frame_id, "front");
  EXPECT_EQ(image.height, 1U);
  EXPECT_EQ(image.width, 2U);
  EXPECT_EQ(image.encoding, "mono8");
  EXPECT_EQ(image.is_bigendian, 1);
  EXPECT_EQ(image.step, 2U);
  EXPECT_EQ(image.data, (std::vector<std::uint8_t>{200, 100}));
}

TEST(RosMessages, CompressedImage) {
  const auto image = decoded<CompressedImage>(
      header(-1, 2, "a").text("rgb8; jpeg compressed bgr8").blob({255, 216, 255}));
  EXPECT_EQ(image.header.stamp, (Time{-1, 2}));
  EXPECT_EQ(image.format, "rgb8; jpeg compressed bgr8");
  EXPECT_EQ(image.data, (std::vector<std::uint8_t>{255, 216, 255}));
}

TEST(RosMessages, CameraInfo) {
  WrittenCdr cdr = header(1, 2, "front");
  cdr.number(400U).number(640U).text("plumb_bob").number(1U).number(0.25);
  for (int i = 0; i < 9 + 9 + 12; ++i) cdr.number(i + 0.5);
  cdr.number(2U).number(3U).number(4U).number(5U).number(6U).number(7U).number(octet(1));
  const auto info = decoded<CameraInfo>(cdr);
  EXPECT_EQ(info.height, 400U);
  EXPECT_EQ(info.width, 640U);
  EXPECT_EQ(info.distortion_model, "plumb_bob");
  EXPECT_EQ(info.d, std::vector{0.25});
  EXPECT_EQ(info.k[0], 0.5);
  EXPECT_EQ(info.k[8], 8.5);
  EXPECT_EQ(info.r[8], 17.5);
  EXPECT_EQ(info.p[11], 29.5);
  EXPECT_EQ(info.binning_x, 2U);
  EXPECT_EQ(info.binning_y, 3U);
  EXPECT_EQ(info.roi.x_offset, 4U);
  EXPECT_EQ(info.roi.y_offset, 5U);
  EXPECT_EQ(info.roi.height, 6U);
  EXPECT_EQ(info.roi.width, 7U);
  EXPECT_TRUE(info.roi.do_rectify);
}

TEST(RosMessages, DiagnosticArray) {
  const auto array = decoded<DiagnosticArray>(header(1, 2, "")
                                                  .number(2U)
                                                  .number(octet(2))
                                                  .text("camera")
                                                  .text("stalled")
                                                  .text("serial 5")
                                                  .number(1U)
                                                  .text("frames")
                                                  .text("12")
                                                  .number(octet(0))
                                                  .text("board")
                                                  .text("")
                                                  .text("")
                                                  .number(0U));
  ASSERT_EQ(array.status.size(), 2U);
  EXPECT_EQ(array.status[0].level, 2);
  EXPECT_EQ(array.status[0].name, "camera");
  EXPECT_EQ(array.status[0].message, "stalled");
  EXPECT_EQ(array.status[0].hardware_id, "serial 5");
  ASSERT_EQ(array.status[0].values.size(), 1U);
  EXPECT_EQ(array.status[0].values[0].key, "frames");
  EXPECT_EQ(array.status[0].values[0].value, "12");
  EXPECT_EQ(array.status[1].name, "board");
}

TEST(RosMessages, ProcessState) {
  const auto state = decoded<ProcessState>(header(1, 2, "")
                                               .number(std::uint64_t{3})
                                               .number(std::uint64_t{4})
                                               .number(std::uint64_t{5})
                                               .number(std::uint16_t{6})
                                               .number(7U)
                                               .number(octet(1))
                                               .number(std::uint64_t{8})
                                               .number(1U)
                                               .text("camera")
                                               .text("left")
                                               .number(2U)
                                               .text("fault")
                                               .number(0.0)
                                               .text("")
                                               .text("camera delivers")
                                               .text("skew_ms")
                                               .number(0.25)
                                               .text("ms")
                                               .text(""));
  EXPECT_EQ(state.header.stamp, (Time{1, 2}));
  EXPECT_EQ(state.frame_set, 3U);
  EXPECT_EQ(state.trigger, 4U);
  EXPECT_EQ(state.result, 5U);
  EXPECT_EQ(state.recipe, 6U);
  EXPECT_EQ(state.configuration_checksum, 7U);
  EXPECT_EQ(state.system_state, 1U);
  EXPECT_EQ(state.heartbeat, 8U);
  ASSERT_EQ(state.components.size(), 1U);
  EXPECT_EQ(state.components[0].kind, "camera");
  EXPECT_EQ(state.components[0].name, "left");
  ASSERT_EQ(state.components[0].figures.size(), 2U);
  EXPECT_EQ(state.components[0].figures[0].text, "camera delivers");
  EXPECT_EQ(state.components[0].figures[1].name, "skew_ms");
  EXPECT_EQ(state.components[0].figures[1].value, 0.25);
  EXPECT_EQ(state.components[0].figures[1].unit, "ms");
}

TEST(RosMessages, Event) {
  const auto event = decoded<Event>(header(1, 2, "")
                                        .number(std::uint64_t{3})
                                        .text("alarm")
                                        .text("weld: hot_spot_width")
                                        .number(octet(2))
                                        .text("raised")
                                        .number(1U)
                                        .text("value")
                                        .number(3.5)
                                        .text("mm")
                                        .text(""));
  EXPECT_EQ(event.number, 3U);
  EXPECT_EQ(event.kind, "alarm");
  EXPECT_EQ(event.source, "weld: hot_spot_width");
  EXPECT_EQ(event.severity, 2U);
  EXPECT_EQ(event.text, "raised");
  ASSERT_EQ(event.figures.size(), 1U);
  EXPECT_EQ(event.figures[0].value, 3.5);
}

template <class Info>
void expect_discovery_info() {
  constexpr std::size_t kSize = sizeof(Info::gid);
  WrittenCdr cdr;
  const auto gid = [&cdr](int first) {
    for (std::size_t i = 0; i < kSize; ++i) cdr.number(octet(first + static_cast<int>(i)));
  };
  gid(1);
  cdr.number(1U).text("/").text("orbwatch").number(0U).number(2U);
  gid(50);
  gid(90);
  const auto info = decoded<Info>(cdr);
  EXPECT_EQ(info.gid[0], 1);
  EXPECT_EQ(info.gid[kSize - 1], kSize);
  ASSERT_EQ(info.nodes.size(), 1U);
  EXPECT_EQ(info.nodes[0].node_namespace, "/");
  EXPECT_EQ(info.nodes[0].node_name, "orbwatch");
  EXPECT_TRUE(info.nodes[0].reader_gids.empty());
  ASSERT_EQ(info.nodes[0].writer_gids.size(), 2U);
  EXPECT_EQ(info.nodes[0].writer_gids[1][0], 90);
}

TEST(RosMessages, DiscoveryInfoSinceIron) { expect_discovery_info<DiscoveryInfo>(); }
TEST(RosMessages, DiscoveryInfoOfHumble) { expect_discovery_info<HumbleDiscoveryInfo>(); }

TEST(RosMessages, WhatIsCutOrTooLongIsNoMessage) {
  const auto whole = sent(small_image());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(decode<Image>(std::span(whole).first(size))) << size << " bytes";
  }
  auto longer = whole;
  longer.resize(whole.size() + 3);
  EXPECT_TRUE(decode<Image>(longer)) << "padding";
  longer.resize(whole.size() + 4);
  EXPECT_FALSE(decode<Image>(longer));
}

TEST(RosMessages, ParameterListsAreNoPlainCdr) {
  auto bytes = sent(small_image());
  constexpr std::uint8_t kParameterList = 3;
  bytes[1] = kParameterList;
  EXPECT_FALSE(decode<Image>(bytes));
}

}  // namespace
}  // namespace orbwatch::tests::ros
