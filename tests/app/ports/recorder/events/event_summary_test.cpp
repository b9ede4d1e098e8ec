// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace orbwatch::app::recorder {
namespace {

using testing::HasSubstr;

EventSummary summary_of_all() {
  EventSummary summary;
  summary.trigger = "layer";
  summary.text = "the layer changed";
  summary.alarm = {"pool", "hot_spot_width", signals::AlarmLevel::HighAlarm, 27.25, "mm"};
  summary.line = "button";
  summary.first = summary.triggered = summary.last = "2026-11-28T09:22:00.125Z";
  summary.frame_set = 18446744073709551615U;
  summary.recipe = 65535;
  summary.part = "Flügel 7";
  summary.layer = 12.5;
  summary.pictures = {{"thermal", 321}, {"colour", 0}};
  summary.lost = 3;
  summary.has_beginning = false;
  summary.is_interrupted = true;
  summary.versions = {{"orbwatch", "0.1.0"}};
  return summary;
}

TEST(EventSummary, IsReadAsItWasWritten) {
  for (const EventSummary& summary : {EventSummary(), summary_of_all()}) {
    const std::string text = summary_text(summary);
    const auto read = parse_summary(text);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(summary_text(*read), text);
  }
  EXPECT_EQ(parse_summary(summary_text(summary_of_all()))->frame_set, 18446744073709551615U);
}

TEST(EventSummary, AnEarlierVersionsHasNoPartsOfItsCause) {
  EventSummary summary = summary_of_all();
  summary.alarm.reset();
  summary.line.clear();
  std::string text = summary_text(summary);
  for (const std::string member : {"  \"alarm\": null,\n", "  \"line\": null,\n"}) {
    ASSERT_THAT(text, HasSubstr(member));
    text.erase(text.find(member), member.size());
  }
  const auto read = parse_summary(text);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(summary_text(*read), summary_text(summary));
}

TEST(EventSummary, AnAlarmWithoutAValueIsReadAndALevelThatThereIsNotIsRefused) {
  EventSummary summary = summary_of_all();
  summary.alarm->value = signals::kNotValid;
  std::string text = summary_text(summary);
  const auto read = parse_summary(text);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(signals::is_valid(read->alarm->value));
  const std::string level = "\"level\": 4";
  text.replace(text.find(level), level.size(), "\"level\": 6");
  EXPECT_THAT(parse_summary(text).error().message, HasSubstr("there is no level 6 of an alarm"));
}

TEST(EventSummary, NumbersThatItCannotHaveAreRefused) {
  const std::string text = summary_text(summary_of_all());
  for (const auto& [right, wrong] : {std::pair("65535", "65536"),
                                     {"65535", "-1"},
                                     {"65535", "1.5"},
                                     {"65535", "1e300"},
                                     {"18446744073709551615", "18446744073709551616"},
                                     {"321", "-321"},
                                     {"321", "true"}}) {
    std::string other = text;
    other.replace(other.find(right), std::string(right).size(), wrong);
    const auto read = parse_summary(other);
    ASSERT_FALSE(read) << wrong;
    EXPECT_THAT(read.error().message, HasSubstr("a number is not a whole one from 0 to ")) << wrong;
  }
}

TEST(EventSummary, WhatIsNotOneIsRefusedWithoutItsText) {
  EXPECT_EQ(parse_summary("{\"trigger\": \x7f").error().message, "not JSON at byte 13");
  EXPECT_THAT(parse_summary("{}").error().message, HasSubstr("key 'trigger' not found"));
  EXPECT_THAT(parse_summary("[]").error().message, HasSubstr("not a summary of an event"));
}

}  // namespace
}  // namespace orbwatch::app::recorder
