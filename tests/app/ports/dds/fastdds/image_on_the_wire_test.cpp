// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdio>

#include "app/ports/dds/dds_sink.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/fastdds/paced_views.h"
#include "tests/app/ports/dds/fastdds/reader_program.h"
#include "tests/app/ports/dds/fastdds/shipped_network.h"

/// Pictures of the sink received by another vendor's reader, with the shipped network settings.
namespace orbwatch::app::dds {
namespace {

using orbwatch::tests::foreign_reader;
using orbwatch::tests::parsed;
using orbwatch::tests::ReaderProgram;
using tests::ShippedNetwork;

constexpr int kWidth = 320;
constexpr int kHeight = 180;

template <class Number>
std::string crc(const UntouchedVector<Number>& data) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(data.data());
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08lx", crc32_z(0, bytes, data.size() * sizeof(Number)));
  return text.data();
}

struct Path {
  const char* name;
  ShippedNetwork::Kind kind;
  bool reliable;
};

class ImageOnTheWire : public testing::TestWithParam<Path> {
 protected:
  void SetUp() override {
    ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
    network_.emplace(GetParam().kind);
    network_->start(sink_);
  }

  std::unique_ptr<ReaderProgram> reader_of(const std::string& topic) const {
    std::vector<std::string> arguments{"--topic", topic, "--type",           "image",
                                       "--count", "5",   "--receive-buffer", tests::kReceiveBuffer};
    if (!GetParam().reliable) arguments.emplace_back("--best-effort");
    return std::make_unique<ReaderProgram>(network_->readers(),
                                           foreign_reader(tests::kDomain, arguments));
  }

  void hand_over_until_read(ReaderProgram& reader) {
    ASSERT_TRUE(tests::eventually([&] {
      views_.hand_over();
      return !reader.program().runs();
    })) << reader.printed();
    ASSERT_EQ(reader.program().wait(), 0) << reader.printed();
    ASSERT_EQ(reader.samples().size(), 5U) << reader.printed();
  }

  const std::vector<std::shared_ptr<View>> sent_{
      tests::make_view(0, "front", 1, kWidth, kHeight, true),
      tests::make_view(0, "front", 2, kWidth, kHeight, true),
      tests::make_view(0, "front", 3, kWidth, kHeight, true)};
  std::optional<ShippedNetwork> network_;
  DdsSink sink_{{.domain = tests::kDomain}, tests::make_names(), nullptr};
  tests::PacedViews views_{sink_, sent_};
};

TEST_P(ImageOnTheWire, ColourArrivesAsItWasGiven) {
  const auto reader = reader_of("rt/orbwatch/front/image_raw");
  hand_over_until_read(*reader);
  for (const auto& line : reader->samples()) {
    const auto image = parsed(line);
    EXPECT_EQ(image["frame_id"].string(), "front") << line;
    EXPECT_EQ(image["encoding"].string(), "rgb8") << line;
    EXPECT_EQ(static_cast<int>(image["width"]), kWidth) << line;
    EXPECT_EQ(static_cast<int>(image["height"]), kHeight) << line;
    EXPECT_EQ(static_cast<int>(image["step"]), 3 * kWidth) << line;
    EXPECT_THAT(image["crc32"].string(),
                testing::AnyOf(crc(sent_[0]->bytes), crc(sent_[1]->bytes), crc(sent_[2]->bytes)))
        << line;
  }
}

TEST_P(ImageOnTheWire, CountsArriveAsTheyWereGiven) {
  const auto reader = reader_of("rt/orbwatch/front/radiometric/image_raw");
  hand_over_until_read(*reader);
  for (const auto& line : reader->samples()) {
    const auto image = parsed(line);
    EXPECT_EQ(image["encoding"].string(), "mono16") << line;
    EXPECT_EQ(static_cast<int>(image["is_bigendian"]), 0) << line;
    EXPECT_EQ(static_cast<int>(image["step"]), 2 * kWidth) << line;
    EXPECT_THAT(image["crc32"].string(),
                testing::AnyOf(crc(sent_[0]->words), crc(sent_[1]->words), crc(sent_[2]->words)))
        << line;
  }
}

TEST_P(ImageOnTheWire, TheWriterAnnouncesTypeAndHashAsRosDoes) {
  const auto reader = reader_of("rt/orbwatch/front/image_raw");
  hand_over_until_read(*reader);
  const auto match = reader->match();
  ASSERT_TRUE(match);
  const auto writer = parsed(*match);
  EXPECT_EQ(writer["type"].string(), "sensor_msgs::msg::dds_::Image_");
  EXPECT_THAT(writer["user_data"].string(),
              testing::HasSubstr("typehash=RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a"
                                 "4588fb9582527d47;"));
}

INSTANTIATE_TEST_SUITE_P(
    Paths, ImageOnTheWire,
    testing::Values(Path{"ReliableOnTheSameHost", ShippedNetwork::Kind::SameHost, true},
                    Path{"BestEffortOnTheSameHost", ShippedNetwork::Kind::SameHost, false},
                    Path{"ReliableOverTheLan", ShippedNetwork::Kind::Lan, true},
                    Path{"BestEffortOverTheLan", ShippedNetwork::Kind::Lan, false}),
    [](const auto& path) { return std::string(path.param.name); });

}  // namespace
}  // namespace orbwatch::app::dds
