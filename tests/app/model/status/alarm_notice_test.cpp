// SPDX-License-Identifier: Apache-2.0
#include "app/model/status/alarm_notice.h"

#include <gtest/gtest.h>

#include "tests/app/ports/dds/test_status.h"

namespace orbwatch::app {
namespace {

SignalNumber width_number() {
  std::uint16_t number = 0;
  while (operator_text(SignalNumber(number)) != "hot_spot_width") ++number;
  return SignalNumber(number);
}

TEST(EventText, SaysWhatHappenedWhere) {
  AlarmNotice notice;
  notice.event.level = signals::AlarmLevel::HighAlarm;
  notice.event.value = 3.5;
  notice.region = 1;
  notice.signal = width_number();
  notice.recipe = tests::kRecipe;
  EXPECT_EQ(event_text(notice, tests::make_names()),
            "edge: hot_spot_width raised, high alarm, 3.5 mm");
  notice.recipe = 1;  // a recipe whose regions have no names
  notice.event.kind = signals::AlarmEventKind::Cleared;
  notice.event.value = signals::kNotValid;
  EXPECT_EQ(event_text(notice, tests::make_names()),
            "2: hot_spot_width cleared, high alarm, not measured");
}

TEST(Giver, IsCutToWhatFits) {
  const std::string longest(Giver::kMostBytes, 'x');
  EXPECT_EQ(Giver(longest).name(), longest);
  EXPECT_EQ(Giver(longest + "y").name(), longest);
  EXPECT_EQ(Giver().name(), "");
}

}  // namespace
}  // namespace orbwatch::app
