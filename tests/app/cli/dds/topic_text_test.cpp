// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/topic_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace orbwatch::app::cli {
namespace {

const TopicFigures kBrought{.topic = "rt/front",
                            .seconds = 2,
                            .samples = 30,
                            .longest_gap_ms = 80.25,
                            .since_write_ms = 1.5,
                            .since_exposure_ms = 42,
                            .newest = "64x48 rgb8",
                            .lost = 3};

TEST(TopicText, IsALineOfFigures) {
  EXPECT_EQ(topic_line(kBrought),
            "rt/front: 15.0/s, longest gap 80 ms, latency 1.5 ms from writing, 42.0 ms from "
            "exposure, 64x48 rgb8, lost 3");
  EXPECT_EQ(topic_line(TopicFigures{.topic = "rt/a", .seconds = 1, .refused = 2, .refusal = "bad"}),
            "rt/a: nothing, lost 0, refused 2 (bad)");
  EXPECT_EQ(topic_line(TopicSample{"rt/a", "running", 3}), "rt/a: running");
}

TEST(TopicText, IsAnObjectOnALine) {
  const std::string text = topic_json(kBrought);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text), nlohmann::json::parse(R"({
    "topic": "rt/front", "seconds": 2, "samples": 30, "rate": 15, "longest_gap_ms": 80.25,
    "since_write_ms": 1.5, "since_exposure_ms": 42, "newest": "64x48 rgb8", "lost": 3,
    "refused": 0, "refusal": ""})"));
  EXPECT_EQ(nlohmann::json::parse(topic_json(TopicSample{"rt/a", "running", 3.5})),
            nlohmann::json::parse(
                R"({"topic": "rt/a", "content": "running", "since_exposure_ms": 3.5})"));
}

TEST(TopicText, WithoutASampleThereIsNoLatency) {
  const auto json = nlohmann::json::parse(
      topic_json(TopicFigures{.topic = "rt/a", .seconds = 1, .newest = "of an earlier second"}));
  for (const char* key : {"longest_gap_ms", "since_write_ms", "since_exposure_ms", "newest"}) {
    EXPECT_TRUE(json[key].is_null()) << key;
  }
  EXPECT_EQ(json["rate"], 0);
}

TEST(TopicText, IsValidWhateverTheSenderSays) {
  EXPECT_FALSE(nlohmann::json::parse(topic_json(TopicSample{"rt/a", "\xff\"\n", 0}), nullptr, false)
                   .is_discarded());
}

}  // namespace
}  // namespace orbwatch::app::cli
