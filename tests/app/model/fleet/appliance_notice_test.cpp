// SPDX-License-Identifier: Apache-2.0
#include "app/model/fleet/appliance_notice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/ports/dds/test_status.h"

namespace orbwatch::app {
namespace {

ApplianceNotice notice(const Status& status) {
  const StatusNames names = tests::make_names();
  return notice_of({"cell 3", "1.2.3", "orbwatch", {"10.0.0.7", 443}},
                   {status, names, hal::Clock::now(), {}});
}

Status with_alarms(std::initializer_list<signals::AlarmLevel> levels) {
  Status status;
  status.state = SystemState::Running;
  status.recipe = tests::kRecipe;
  for (const auto level : levels) {
    AlarmStatus& alarm = status.alarms[status.alarm_count];
    const bool stands = level != signals::AlarmLevel::None;
    alarm.alarm = {stands ? signals::AlarmState::Unacknowledged : signals::AlarmState::Normal,
                   level, level, false};
    alarm.region = 1;
    alarm.signal = static_cast<SignalNumber>(status.alarm_count++);
  }
  return status;
}

TEST(ApplianceNotice, SaysWhoItIsAndHowTheSystemIs) {
  const ApplianceNotice told = notice(tests::make_status());
  EXPECT_EQ(told.name, "cell 3");
  EXPECT_EQ(told.page.address, "10.0.0.7");
  EXPECT_EQ(told.state, SystemState::Degraded);
  EXPECT_EQ(told.condition.severity, Severity::Warning);
  EXPECT_THAT(told.condition.text, testing::HasSubstr("a camera has a fault"));
}

TEST(ApplianceNotice, NamesTheFirstOfTheWorstAlarmsThatStand) {
  using signals::AlarmLevel;
  const ApplianceNotice told = notice(with_alarms(
      {AlarmLevel::None, AlarmLevel::LowWarning, AlarmLevel::HighAlarm, AlarmLevel::LowAlarm}));
  EXPECT_EQ(told.alarms, 3U);
  EXPECT_EQ(told.alarm.severity, Severity::Alarm);
  EXPECT_EQ(told.alarm.text,
            "3, edge: " + std::string(operator_text(static_cast<SignalNumber>(2))) +
                ": high alarm, in alarm, not acknowledged");
}

TEST(ApplianceNotice, IsSilentAboutAlarmsThatDoNotStand) {
  const ApplianceNotice told = notice(with_alarms({signals::AlarmLevel::None}));
  EXPECT_EQ(told.alarms, 0U);
  EXPECT_EQ(told.alarm.severity, Severity::None);
  EXPECT_EQ(told.alarm.text, "");
}

TEST(UrlOfPage, IsOfANumericAddressOfOneComputer) {
  EXPECT_EQ(url_of({"10.0.0.7", 8443}), "https://10.0.0.7:8443/");
  EXPECT_EQ(url_of({"fd00::7", 443}), "https://[fd00::7]:443/");
  for (const char* address :
       {"", "0.0.0.0", "::", "224.0.0.1", "255.255.255.255", "ff02::1", "10.0.0", "010.0.0.7",
        "evil.example", "10.0.0.7/x", "10.0.0.7:1", "10.0.0.7\n", "[fd00::7]", "fe80::1%eth0",
        "javascript:alert(1)", "user@10.0.0.7"}) {
    EXPECT_EQ(url_of({address, 443}), "") << address;
  }
  EXPECT_EQ(url_of({"10.0.0.7", 0}), "");
}

}  // namespace
}  // namespace orbwatch::app
