// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/subscriber.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <future>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <ostream>
#include <streambuf>

#include "app/cli/dds/writer_types.h"
#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/pictures/image_message.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/foreign_writer.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::cli {
namespace {

using testing::HasSubstr;
using tests::eventually;
using tests::ForeignWriter;
using tests::make_view;

constexpr auto* kFrontTopic = "rt/orbwatch/front/image_raw";
constexpr auto* kStateTopic = "rt/orbwatch/process_state";

/// Text that one thread writes and another one reads.
class SharedText : public std::streambuf {
 public:
  std::string text() const {
    const std::lock_guard lock(mutex_);
    return text_;
  }
  bool matches(const std::string& pattern) const {
    return testing::Value(text(), testing::ContainsRegex(pattern));
  }

 private:
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    const std::lock_guard lock(mutex_);
    text_.append(text, static_cast<std::size_t>(size));
    return size;
  }
  int_type overflow(int_type c) override {
    const char value = traits_type::to_char_type(c);
    xsputn(&value, 1);
    return c;
  }

  mutable std::mutex mutex_;
  std::string text_;
};

/// Runs subscribe() on a thread of its own, on the readers' side of the network.
class Subscriber {
 public:
  explicit Subscriber(SubscribeOptions options) {
    options.domain = tests::DdsNetwork::kReaderDomain;
    result_ = std::async(std::launch::async, [this, options] {
      std::ostream out(&text_);
      return subscribe(options, cancelled_, out);
    });
  }
  ~Subscriber() { cancelled_ = true; }

  const SharedText& printed() const { return text_; }
  bool has_ended() const {
    return result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }
  Result<std::vector<TopicReport>> cancel() {
    cancelled_ = true;
    return result_.get();
  }

 private:
  SharedText text_;
  std::atomic<bool> cancelled_{false};
  std::future<Result<std::vector<TopicReport>>> result_;
};

/// Image message of 4 x 3 grey pixels, unless the test invalidates it.
struct SmallImage {
  std::string frame_id = "front";
  std::string encoding = "mono8";
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(12, 7);
  dds::ImageMessage message{};

  SmallImage() {
    message.width = 4;
    message.height = 3;
    message.step = 4;
  }
  const dds::ImageMessage* get() {
    message.header.frame_id = frame_id.data();
    message.encoding = encoding.data();
    const auto size = static_cast<std::uint32_t>(bytes.size());
    message.data = {size, size, bytes.data(), false};
    return &message;
  }
};

class SubscriberTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(network_.valid()); }

  tests::DdsNetwork network_;
  orbwatch::tests::TemporaryFolder folder_;
};

TEST_F(SubscriberTest, EndsWhenEachTopicHasBroughtEnough) {
  dds::DdsSink sink({.domain = tests::DdsNetwork::kSinkDomain}, {{}, {"front"}, {}}, nullptr);
  ASSERT_TRUE(sink.start());
  Subscriber subscriber(
      {.topics = {"orbwatch/front/image_raw", "orbwatch/process_state"}, .count = 3, .each = true});
  const auto view = make_view(0, "front", 3, 64, 48, true);
  ASSERT_TRUE(eventually([&] {
    tests::hand_over(sink, view);
    return subscriber.printed().matches("(rt/orbwatch/front/image_raw: 64x48 rgb8\n){4}");
  })) << subscriber.printed().text();
  EXPECT_FALSE(subscriber.has_ended()) << "the state has brought nothing";
  ASSERT_TRUE(eventually([&] {
    sink.accept(tests::make_status());
    return subscriber.has_ended();
  })) << subscriber.printed().text();
  const auto report = subscriber.cancel();
  ASSERT_TRUE(report) << report.error().message;
  for (const auto& topic : *report) EXPECT_GE(topic.received, 3U) << topic.topic;
}

TEST_F(SubscriberTest, SavesWhatTheSinkPublishes) {
  dds::DdsSink sink({.domain = tests::DdsNetwork::kSinkDomain}, {{}, {"front"}, {}}, nullptr);
  ASSERT_TRUE(sink.start());
  const auto folder = folder_.path() / "new";
  Subscriber subscriber(
      {.topics = {"orbwatch/front/image_raw", "rt/orbwatch/front/radiometric/image_raw",
                  "/orbwatch/process_state"},
       .save = folder,
       .stats = true,
       .each = true});
  const auto view = make_view(0, "front", 3, 64, 48, true);
  ASSERT_TRUE(eventually([&] {
    tests::hand_over(sink, view);
    sink.accept(tests::make_status());
    const auto& printed = subscriber.printed();
    const std::string figures =
        ": [0-9.]+/s, longest gap [0-9]+ ms, latency [-0-9.]+ ms from writing, [-0-9.]+ ms from "
        "exposure, ";
    return printed.matches("front/image_raw" + figures + "64x48 rgb8, lost [0-9]+\n") &&
           printed.matches("radiometric/image_raw" + figures + "64x48 mono16, lost [0-9]+\n") &&
           printed.matches("process_state" + figures +
                           "degraded, frame set 1000000000001, trigger 1000000000002, "
                           "heartbeat 1000000000000, lost") &&
           printed.matches("front/image_raw: 64x48 rgb8\n");
  })) << subscriber.printed().text();
  const auto report = subscriber.cancel();
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_EQ(report->size(), 3u);
  for (const auto& topic : *report) {
    EXPECT_GT(topic.received, 0u) << topic.topic;
    EXPECT_EQ(topic.refused, 0u) << topic.refusal;
  }
  EXPECT_EQ((*report)[0].saved, folder / "front.png");
  EXPECT_EQ((*report)[1].saved, folder / "front-radiometric.png");
  EXPECT_EQ((*report)[2].saved, "");

  const cv::Mat colour = cv::imread((folder / "front.png").string(), cv::IMREAD_UNCHANGED);
  const cv::Mat counts =
      cv::imread((folder / "front-radiometric.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(colour.type(), CV_8UC3);
  ASSERT_EQ(counts.type(), CV_16UC1);
  ASSERT_EQ(colour.size(), cv::Size(64, 48));
  ASSERT_EQ(counts.size(), cv::Size(64, 48));
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto* rgb = view->picture.samples<std::uint8_t>().at(x, y);
      ASSERT_EQ(colour.at<cv::Vec3b>(y, x), cv::Vec3b(rgb[2], rgb[1], rgb[0])) << x << ' ' << y;
      ASSERT_EQ(counts.at<std::uint16_t>(y, x), *view->radiometric.at(x, y)) << x << ' ' << y;
    }
  }
}

TEST_F(SubscriberTest, ReadsCompressedPicturesAndRefusesWhatIsNone) {
  ForeignWriter writer(tests::DdsNetwork::kSinkDomain, sensor_msgs_msg_dds__CompressedImage__desc,
                       "rt/orbwatch/front/image_raw/compressed", dds::frame_qos());
  const auto folder = folder_.path() / "jpeg";
  Subscriber subscriber(
      {.topics = {"orbwatch/front/image_raw/compressed"}, .save = folder, .each = true});
  ASSERT_TRUE(writer.wait_for_reader());
  const cv::Mat grey(24, 32, CV_8UC1, cv::Scalar(90));
  std::vector<std::uint8_t> jpeg;
  ASSERT_TRUE(cv::imencode(".jpg", grey, jpeg));
  std::string frame_id = "front", format = "mono8; jpeg compressed mono8";
  const auto write = [&](std::vector<std::uint8_t> bytes) {
    dds::CompressedImageMessage message{};
    message.header.frame_id = frame_id.data();
    message.format = format.data();
    const auto size = static_cast<std::uint32_t>(bytes.size());
    message.data = {size, size, bytes.data(), false};
    writer.write(&message);
  };
  write({});
  write({0xFF, 0xD8, 0xFF, 'n', 'o', 'n', 'e'});
  write(jpeg);
  ASSERT_TRUE(writer.flush());
  ASSERT_TRUE(eventually([&] {
    return subscriber.printed().matches("compressed: 32x24 jpeg, [0-9]+ bytes\n");
  })) << subscriber.printed().text();
  const auto report = subscriber.cancel();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ((*report)[0].received, 1u);
  EXPECT_EQ((*report)[0].refused, 2u);
  EXPECT_THAT((*report)[0].refusal, HasSubstr("JPEG"));
  EXPECT_EQ((*report)[0].saved, folder / "front-compressed.png");
  const cv::Mat saved = cv::imread((*report)[0].saved.string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(saved.size(), grey.size());
  EXPECT_LE(cv::norm(saved, grey, cv::NORM_INF), 2);
}

TEST_F(SubscriberTest, SavesTheNewest) {
  const ForeignWriter writer(tests::DdsNetwork::kSinkDomain, sensor_msgs_msg_dds__Image__desc,
                             kFrontTopic, dds::frame_qos());
  Subscriber subscriber({.topics = {kFrontTopic}, .save = folder_.path()});
  ASSERT_TRUE(writer.wait_for_reader());
  SmallImage image;
  for (std::uint8_t level = 1; level <= 20; ++level) {
    image.bytes.assign(12, level);
    writer.write(image.get());
  }
  ASSERT_TRUE(writer.flush());
  const auto report = subscriber.cancel();
  ASSERT_TRUE(report) << report.error().message;
  const cv::Mat saved = cv::imread((folder_.path() / "front.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(saved.size(), cv::Size(4, 3));
  EXPECT_EQ(saved.at<std::uint8_t>(2, 3), 20);
}

TEST_F(SubscriberTest, RefusesImagesThatDoNotAddUp) {
  const ForeignWriter writer(tests::DdsNetwork::kSinkDomain, sensor_msgs_msg_dds__Image__desc,
                             kFrontTopic, dds::frame_qos());
  Subscriber subscriber({.topics = {kFrontTopic}, .save = folder_.path()});
  ASSERT_TRUE(writer.wait_for_reader());
  SmallImage good;
  writer.write(good.get());
  SmallImage bad[7];
  bad[0].message.height = 4;
  bad[1].message.step = 3;
  bad[2].bytes.clear();
  bad[3].message.width = 0;
  bad[4].message.width = bad[4].message.height = bad[4].message.step = 0xFFFFFFFF;
  bad[5].encoding = "mono16";
  bad[6].encoding = std::string(100'000, '%');
  for (auto& image : bad) {
    writer.write(image.get());
    ASSERT_TRUE(writer.flush()) << "each must be seen, not replaced by the next";
  }
  const auto report = subscriber.cancel();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ((*report)[0].received, 1u);
  EXPECT_EQ((*report)[0].refused, 7u);
  EXPECT_EQ((*report)[0].refusal, "image: encoding is none of rgb8, bgr8, mono8, mono16");
  const cv::Mat saved = cv::imread((folder_.path() / "front.png").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(saved.size(), cv::Size(4, 3)) << "the sound one is what is saved";
}

TEST_F(SubscriberTest, RefusesStatesThatItDoesNotKnow) {
  const ForeignWriter writer(tests::DdsNetwork::kSinkDomain,
                             orbwatch_msgs_msg_dds__ProcessState__desc, kStateTopic,
                             dds::state_qos());
  Subscriber subscriber({.topics = {kStateTopic}});
  ASSERT_TRUE(writer.wait_for_reader());
  dds::ProcessStateMessage message{};
  message.header.stamp = {INT32_MIN, UINT32_MAX};
  writer.write(&message);
  message.system_state = 200;
  writer.write(&message);
  ASSERT_TRUE(writer.flush());
  const auto report = subscriber.cancel();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ((*report)[0].received, 1u);
  EXPECT_EQ((*report)[0].refused, 1u);
  EXPECT_THAT((*report)[0].refusal, HasSubstr("system state 200"));
}

TEST_F(SubscriberTest, EndsByItselfAndSaysThatNothingCame) {
  const std::atomic<bool> cancelled{false};
  SharedText text;
  std::ostream out(&text);
  const auto report = subscribe({.domain = tests::DdsNetwork::kReaderDomain,
                                 .save = folder_.path(),
                                 .seconds = 1.2,
                                 .stats = true},
                                cancelled, out);
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_EQ(report->size(), 2u) << "the selected view and the process state";
  EXPECT_EQ((*report)[0].topic, "rt/orbwatch/selected/image_raw");
  EXPECT_EQ((*report)[1].topic, kStateTopic);
  EXPECT_EQ((*report)[0].received + (*report)[1].received, 0u);
  EXPECT_EQ(folder_.files(), 0);
  EXPECT_THAT(text.text(), HasSubstr("rt/orbwatch/selected/image_raw: nothing, lost 0\n"));
}

TEST_F(SubscriberTest, EndsWithTheTypeOfATopicThatItCannotRead) {
  const auto* const topic = "rt/robot/state_of_it";
  const ForeignWriter writer(tests::DdsNetwork::kSinkDomain,
                             orbwatch_msgs_msg_dds__ProcessState__desc, topic, dds::state_qos());
  Subscriber subscriber({.topics = {topic}});
  ASSERT_TRUE(eventually([&] { return subscriber.has_ended(); })) << "it waits for ever";
  const auto report = subscriber.cancel();
  ASSERT_FALSE(report);
  for (const char* part : {topic, "orbwatch_msgs/msg/ProcessState", "sensor_msgs/msg/Image",
                           "sensor_msgs/msg/CompressedImage"}) {
    EXPECT_THAT(report.error().message, HasSubstr(part));
  }
}

TEST_F(SubscriberTest, ReadsATopicThatOthersWriteWithAnotherTypeToo) {
  const ForeignWriter other(tests::DdsNetwork::kSinkDomain,
                            orbwatch_msgs_msg_dds__ProcessState__desc, kFrontTopic,
                            dds::state_qos());
  const ForeignWriter writer(tests::DdsNetwork::kSinkDomain, sensor_msgs_msg_dds__Image__desc,
                             kFrontTopic, dds::frame_qos());
  Subscriber subscriber({.topics = {kFrontTopic}, .seconds = 3});
  ASSERT_TRUE(writer.wait_for_reader());
  SmallImage image;
  writer.write(image.get());
  ASSERT_TRUE(eventually([&] { return subscriber.has_ended(); }));
  const auto report = subscriber.cancel();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ((*report)[0].received, 1u);
}

TEST(TypeText, IsThatOfRosOnOneLine) {
  EXPECT_EQ(type_text("sensor_msgs::msg::dds_::Image_"), "sensor_msgs/msg/Image");
  EXPECT_EQ(type_text("Temperature"), "Temperature");
  EXPECT_EQ(type_text("a\n\x1b[2J"), "a??[2J");
}

TEST_F(SubscriberTest, WhatCannotBeDoneIsRefused) {
  const std::atomic<bool> cancelled{true};
  std::ostream out(nullptr);
  const auto refusal = [&](SubscribeOptions options) {
    if (options.domain == 0) options.domain = tests::DdsNetwork::kReaderDomain;
    const auto report = subscribe(options, cancelled, out);
    return report ? std::string() : report.error().message;
  };
  EXPECT_THAT(refusal({.domain = 231}), HasSubstr("domain 231"));
  EXPECT_THAT(refusal({.topics = {"a/b", "rt/a/b"}}), HasSubstr("named twice"));
  EXPECT_THAT(refusal({.topics = {"a/b"}, .save = "/proc/absent"}), HasSubstr("/proc/absent"));
  EXPECT_THAT(refusal({.topics = {"a b"}}), HasSubstr("topic rt/a b"));
}

}  // namespace
}  // namespace orbwatch::app::cli
