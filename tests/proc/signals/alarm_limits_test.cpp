// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/alarm_limits.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <string>

#include "tests/proc/signals/signal_index.h"

namespace orbwatch::signals {
namespace {

using std::chrono::nanoseconds;
using testing::HasSubstr;

AlarmLimits good() {
  AlarmLimits limits;
  limits.signal = index_of("hot_spot_yaw");
  limits.low_alarm = -40;
  limits.low_warning = -20;
  limits.high_warning = 10;
  limits.high_alarm = 30;
  limits.hysteresis = 2;
  limits.on_delay = limits.off_delay = std::chrono::seconds(1);
  return limits;
}

TEST(AlarmLimitsCheck, AcceptsWhatIsInOrder) {
  EXPECT_TRUE(check(good()));
  AlarmLimits one;
  one.signal = index_of("hot_spot_yaw");
  one.high_alarm = 180;
  EXPECT_TRUE(check(one)) << "the end of the range can be reached";
}

struct Mistake {
  std::string message;
  std::function<void(AlarmLimits&)> make;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.message; }

class AlarmLimitsMistake : public testing::TestWithParam<Mistake> {};

TEST_P(AlarmLimitsMistake, IsNamed) {
  AlarmLimits limits = good();
  GetParam().make(limits);
  const auto checked = check(limits);
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message, HasSubstr(GetParam().message));
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Each, AlarmLimitsMistake,
    testing::Values(
        Mistake{"signal 1000 does not exist", [](AlarmLimits& l) { l.signal = 1000; }},
        Mistake{"no limit is set",
                [](AlarmLimits& l) {
                  l.low_alarm = l.low_warning = l.high_warning = l.high_alarm = std::nullopt;
                }},
        Mistake{"high alarm nan is not within the signal's range, -180 to 180",
                [](AlarmLimits& l) { l.high_alarm = kNan; }},
        Mistake{"low alarm -inf is not within", [](AlarmLimits& l) { l.low_alarm = -kInfinity; }},
        Mistake{"high alarm 180.5 is not within", [](AlarmLimits& l) { l.high_alarm = 180.5; }},
        Mistake{"low alarm -20 is not below low warning -20",
                [](AlarmLimits& l) { l.low_alarm = -20; }},
        Mistake{"low warning 11 is not below high warning 10",
                [](AlarmLimits& l) { l.low_warning = 11; }},
        Mistake{"low alarm 31 is not below high alarm 30",
                [](AlarmLimits& l) {
                  l.low_warning = l.high_warning = std::nullopt;
                  l.low_alarm = 31;
                }},
        Mistake{"hysteresis -1 is not 0 or more", [](AlarmLimits& l) { l.hysteresis = -1; }},
        Mistake{"hysteresis nan is not 0 or more", [](AlarmLimits& l) { l.hysteresis = kNan; }},
        Mistake{"hysteresis 20 is not below the gap between low alarm -40 and low warning -20",
                [](AlarmLimits& l) { l.hysteresis = 20; }},
        Mistake{
            "hysteresis 15 is not below half of the gap between low warning -20 and high warning "
            "10",
            [](AlarmLimits& l) { l.hysteresis = 15; }},
        Mistake{"on delay -1e-09 s is not within 0 to 3600 s",
                [](AlarmLimits& l) { l.on_delay = nanoseconds(-1); }},
        Mistake{"off delay 7200 s is not within",
                [](AlarmLimits& l) { l.off_delay = std::chrono::hours(2); }},
        Mistake{"loss delay -1 s is not within",
                [](AlarmLimits& l) { l.loss_delay = std::chrono::seconds(-1); }}));

}  // namespace
}  // namespace orbwatch::signals
