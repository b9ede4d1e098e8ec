// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/history_routes.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/model/status/json.h"
#include "tests/app/ports/web/served.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using app::tests::kRecipe;
using nlohmann::json;
using testing::HasSubstr;

class History : public Served {
 protected:
  void SetUp() override {
    MeasuredRecipe recipe;
    recipe.number = kRecipe;
    recipe.alarms.resize(2);
    recipe.alarms[1].high_alarm = 3.25;
    recipes = {recipe};
    start();
  }
  AlarmNotice happen(signals::AlarmEventKind kind, double value, const Giver& by = {}) {
    AlarmNotice notice;
    notice.number = ++noticed;
    notice.event = {
        1, kind, signals::AlarmState::Unacknowledged, signals::AlarmLevel::HighAlarm, value, {}};
    notice.recipe = kRecipe;
    notice.stamp = hal::Clock::now();
    notice.by = by;
    sink->accept_event(notice);
    return notice;
  }
  /// Ends the sink, if one runs, and starts another one that keeps its history in the folder.
  void restart() {
    sink.reset();
    noticed = 0;
    state_folder = folder.path();
    start();
  }
  void TearDown() override { sink.reset(); }  // while the folder exists
  json alarms(const std::string& query = "") const {
    return json::parse(get(port(), "/api/v1/history/alarms" + query).body)["alarms"];
  }

  const orbwatch::tests::TemporaryFolder folder;
  std::uint64_t noticed = 0;
};

TEST_F(History, OfAFigureIsFilledWhileTheSinkRuns) {
  json series;
  ASSERT_TRUE(eventually([&] {
    sink->accept(app::tests::make_status());
    const Answer answer = get(port(), "/api/v1/history?region=edge&figure=hot_spot_width");
    if (answer.status != 200) return false;
    series = json::parse(answer.body);
    return !series["low"].empty() && !series["low"].back().is_null();
  }));
  const double width = app::tests::make_status().regions[1].signals.hot_spot_width;
  EXPECT_NEAR(series["low"].back(), width, width * 1e-6);
  EXPECT_EQ(series["high"].size(), series["low"].size());
  EXPECT_EQ(series["unit"], "mm");
  EXPECT_EQ(series["step"], 0.5);
  EXPECT_GE(series["age"], 0.0);
  EXPECT_EQ(get(port(), "/api/v1/history?camera=thermal&figure=blur").status, 200);
}

TEST_F(History, OfAlarmsGoesOnAfterARestart) {
  restart();
  happen(signals::AlarmEventKind::Raised, 3.5);
  happen(signals::AlarmEventKind::Cleared, 1);
  const json before = alarms();
  ASSERT_EQ(before.size(), 2U);
  recipes.clear();  // the events keep the limits and names of their recipe
  restart();
  EXPECT_EQ(alarms(), before);
  happen(signals::AlarmEventKind::Raised, 4.5);
  const json after = alarms();
  ASSERT_EQ(after.size(), 3U);
  EXPECT_EQ(after[2]["number"], 3);
  EXPECT_EQ(after[2]["value"], 4.5);
  EXPECT_EQ(alarms("?events=2"), json({after[1], after[2]}));
  restart();
  EXPECT_EQ(alarms(), after);
}

TEST_F(History, OfAlarmsIsBounded) {
  constexpr std::size_t kOfARun = AlarmHistory::kMost - 100;
  for (int run = 0; run < 2; ++run) {
    restart();
    for (std::size_t n = 0; n < kOfARun; ++n) happen(signals::AlarmEventKind::Raised, 1);
  }
  restart();
  const json all = alarms("?events=" + std::to_string(AlarmHistory::kMost));
  ASSERT_EQ(all.size(), AlarmHistory::kMost);
  EXPECT_EQ(all.back()["number"], 2 * kOfARun);
  EXPECT_LT(std::filesystem::file_size(state_folder / "alarm-history.json"), 1U << 20);
}

TEST_F(History, OfAlarmsBeginsAnewWithADamagedFile) {
  const std::filesystem::path file = folder.path() / "alarm-history.json";
  for (const char* text : {"", "{", "[]", R"({"alarms": [1]})", R"({"alarms": [{"number": 1}]})"}) {
    sink.reset();
    std::ofstream(file) << text;
    std::filesystem::permissions(file, std::filesystem::perms(0600));
    restart();
    EXPECT_TRUE(alarms().empty()) << text;
    happen(signals::AlarmEventKind::Raised, 1);
    restart();
    EXPECT_EQ(alarms().size(), 1U) << text;
  }
}

TEST_F(History, SaysWhichFiguresThereAre) {
  const auto refusal = [this](const std::string& query, int status) {
    const Answer answer = get(port(), "/api/v1/history" + query);
    EXPECT_EQ(answer.status, status) << query;
    return json::parse(answer.body)["error"].get<std::string>();
  };
  for (const char* query : {"", "?region=weld"}) {
    EXPECT_THAT(refusal(query, 400), HasSubstr("figure is missing; it must be a string"));
  }
  for (const char* query : {"?figure=blur", "?region=a&camera=b&figure=blur"}) {
    EXPECT_THAT(refusal(query, 400), HasSubstr("either region=NAME or camera=NAME must be set"));
  }
  ASSERT_TRUE(eventually([&] {
    return refusal("?region=none&figure=blur", 404)
        .ends_with("region=weld, region=edge, camera=colour, camera=thermal");
  }));
}

TEST_F(History, OfAlarmsSaysWhatHappenedWhenByWhichLimitAndWhoKnew) {
  happen(signals::AlarmEventKind::Raised, 3.5);
  happen(signals::AlarmEventKind::Acknowledged, signals::kNotValid, Giver("anna"));
  const json events = alarms();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0]["number"], 1);
  EXPECT_THAT(events[0]["time"].get<std::string>(), testing::StartsWith("20"));
  EXPECT_THAT(events[0]["name"].get<std::string>(), testing::StartsWith("2, weld: "));
  EXPECT_EQ(events[0]["event_text"], "raised");
  EXPECT_EQ(events[0]["level_text"], "high alarm");
  EXPECT_EQ(events[0]["value"], 3.5);
  EXPECT_EQ(events[0]["limit"], 3.25);
  EXPECT_TRUE(events[0]["by"].is_null());
  EXPECT_EQ(events[1]["event_text"], "acknowledged");
  EXPECT_TRUE(events[1]["value"].is_null());
  EXPECT_EQ(events[1]["by"], "anna");
  EXPECT_EQ(sink->statistics().alarm_events, 2U);
}

TEST_F(History, OfAlarmsHasTheReadingsOfAllInterfaces) {
  const AlarmNotice notice = happen(signals::AlarmEventKind::Raised, 3.5);
  const StatusNames names = app::tests::make_names();
  const auto readings = to_json(notice_readings(notice, names));
  const json event = alarms()[0];
  for (const auto& [name, value] : readings.items()) EXPECT_EQ(event[name], json(value)) << name;
}

TEST_F(History, OfAlarmsKeepsTheNewest) {
  for (std::size_t i = 0; i < AlarmHistory::kMost + 3; ++i) {
    happen(signals::AlarmEventKind::Raised, 4);
  }
  EXPECT_EQ(alarms().size(), 100U);
  const json all = alarms("?events=500");
  ASSERT_EQ(all.size(), AlarmHistory::kMost);
  EXPECT_EQ(all.front()["number"], 4);
  EXPECT_EQ(all.back()["number"], AlarmHistory::kMost + 3);
  EXPECT_EQ(alarms("?events=2")[0]["number"], AlarmHistory::kMost + 2);
  EXPECT_EQ(alarms("?events=0").size(), 0U);
  for (const char* query : {"?events=501", "?events=-1", "?events=x"}) {
    EXPECT_EQ(get(port(), "/api/v1/history/alarms" + std::string(query)).status, 400) << query;
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
