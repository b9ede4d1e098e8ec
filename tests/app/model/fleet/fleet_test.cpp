// SPDX-License-Identifier: Apache-2.0
#include "app/model/fleet/fleet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace orbwatch::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

ApplianceNotice named(const std::string& name) {
  ApplianceNotice notice;
  notice.name = name;
  return notice;
}

class FleetTest : public testing::Test {
 protected:
  void receive(const std::string& id, const std::string& name) {
    fleet.receive(id, named(name), now);
  }
  /// Receives a notice of each once a second.
  void hear_for(seconds duration, const std::vector<std::pair<std::string, std::string>>& ones) {
    for (auto n = seconds(0); n < duration; ++n) {
      for (const auto& [id, name] : ones) receive(id, name);
      now += seconds(1);
    }
  }
  /// Ids in the list; "(id)" if gone.
  std::vector<std::string> listed() {
    std::vector<std::string> ids;
    for (const auto& entry : fleet.list(now)) {
      ids.push_back(entry.is_gone ? "(" + entry.id + ")" : entry.id);
    }
    return ids;
  }
  using Ids = std::vector<std::string>;

  Fleet fleet;
  hal::TimePoint now{seconds(1000)};
};

TEST_F(FleetTest, IsInOrderOfNamesWhoeverIsHeardFirst) {
  receive("1", "b");
  receive("2", "a");
  EXPECT_EQ(listed(), (Ids{"2", "1"}));
  fleet.set_own_id("1");
  const auto entries = fleet.list(now);
  EXPECT_FALSE(entries[0].is_self);
  EXPECT_TRUE(entries[1].is_self);
}

TEST_F(FleetTest, HasTheNewestNotice) {
  receive("1", "a");
  ApplianceNotice notice = named("a");
  notice.alarms = 2;
  fleet.receive("1", notice, now += seconds(1));
  ASSERT_EQ(fleet.list(now).size(), 1U);
  EXPECT_EQ(fleet.list(now)[0].notice.alarms, 2U);
  EXPECT_EQ(fleet.list(now)[0].newest, now);
}

TEST_F(FleetTest, MarksWhoIsSilentAndNoticesThatItIsBack) {
  receive("1", "a");
  now += Fleet::kSilence;
  EXPECT_EQ(listed(), Ids{"1"});
  now += milliseconds(1);
  EXPECT_EQ(listed(), Ids{"(1)"});
  now += std::chrono::hours(24);
  EXPECT_EQ(listed(), Ids{"(1)"}) << "it stays";
  receive("1", "a");
  EXPECT_EQ(listed(), Ids{"1"});
}

TEST_F(FleetTest, ListsTwoOfOneNameAndMarksTheOneThatIsGone) {
  hear_for(seconds(10), {{"1", "a"}, {"2", "a"}});
  EXPECT_EQ(listed(), (Ids{"1", "2"}));
  hear_for(seconds(10), {{"2", "a"}});
  EXPECT_EQ(listed(), (Ids{"(1)", "2"}));
}

TEST_F(FleetTest, OneThatIsStartedAgainTakesItsOwnPlace) {
  hear_for(seconds(10), {{"1", "a"}, {"2", "a"}, {"3", "b"}});
  hear_for(seconds(2), {{"2", "a"}, {"3", "b"}});
  hear_for(seconds(2), {{"2", "a"}, {"3", "b"}, {"1 again", "a"}});
  EXPECT_EQ(listed(), (Ids{"1", "2", "1 again", "3"})) << "nobody knows yet that 1 is gone";
  hear_for(seconds(10), {{"2", "a"}, {"3", "b"}, {"1 again", "a"}});
  EXPECT_EQ(listed(), (Ids{"2", "1 again", "3"}));
}

TEST_F(FleetTest, OneThatCameTakesThePlaceOfOneOnly) {
  hear_for(seconds(1), {{"1", "a"}, {"2", "a"}});
  hear_for(seconds(10), {});
  EXPECT_EQ(listed(), (Ids{"(1)", "(2)"}));
  hear_for(seconds(1), {{"3", "a"}});
  EXPECT_EQ(listed(), (Ids{"(2)", "3"}));
  hear_for(seconds(1), {{"3", "a"}, {"4", "a"}});
  EXPECT_EQ(listed(), (Ids{"3", "4"}));
}

TEST_F(FleetTest, ForgetsThoseThatAreGone) {
  receive("1", "a");
  now += seconds(10);
  receive("2", "b");
  EXPECT_EQ(fleet.forget_gone(now), 1U);
  EXPECT_EQ(listed(), Ids{"2"});
  EXPECT_EQ(fleet.forget_gone(now), 0U);
}

TEST_F(FleetTest, IsBoundedAndWhoIsGoneLongestMakesRoom) {
  for (std::size_t n = 0; n < Fleet::kMost; ++n)
    receive(std::to_string(n), "a" + std::to_string(n));
  receive("late", "late");
  EXPECT_EQ(listed().size(), Fleet::kMost);
  EXPECT_EQ(fleet.counts().turned_away, 1U);
  now += seconds(10);
  for (std::size_t n = 2; n < Fleet::kMost; ++n)
    receive(std::to_string(n), "a" + std::to_string(n));
  receive("late", "late");
  const Ids ids = listed();
  EXPECT_EQ(ids.size(), Fleet::kMost);
  EXPECT_EQ(std::ranges::count(ids, "late"), 1);
  EXPECT_EQ(std::ranges::count(ids, "(0)") + std::ranges::count(ids, "(1)"), 1);
  EXPECT_EQ(fleet.counts().turned_away, 1U);
}

TEST_F(FleetTest, KeepsTheNewestPictureOfThoseThatItKnows) {
  EXPECT_EQ(fleet.picture("1"), nullptr);
  fleet.show("1", "stranger");
  EXPECT_EQ(fleet.counts().refused, 1U);
  receive("1", "a");
  EXPECT_EQ(fleet.picture("1"), nullptr);
  EXPECT_EQ(fleet.list(now)[0].pictures, 0U);
  fleet.show("1", "first");
  fleet.show("1", "second");
  EXPECT_EQ(*fleet.picture("1"), "second");
  EXPECT_EQ(fleet.list(now)[0].pictures, 2U);
  fleet.show("1", std::string(Fleet::kMostPictureBytes + 1, 'x'));
  EXPECT_EQ(*fleet.picture("1"), "second");
  EXPECT_EQ(fleet.counts().refused, 2U);
}

TEST_F(FleetTest, WantsPicturesForAWhileAfterSomebodyLooked) {
  EXPECT_FALSE(fleet.has_viewers(now));
  fleet.note_viewer(now);
  EXPECT_TRUE(fleet.has_viewers(now + seconds(2)));
  EXPECT_FALSE(fleet.has_viewers(now + seconds(60)));
}

}  // namespace
}  // namespace orbwatch::app
