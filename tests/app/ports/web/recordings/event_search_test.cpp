// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/recordings/event_search.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>

namespace orbwatch::app::web::tests {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Event of a second: of the layer n, and of part "Blade 7" or "ring" by turns.
RecordedEvent event_at(int second) {
  char time[40];
  std::snprintf(time, sizeof time, "2026-11-28T12:%02d:%02d.125000000Z", second / 60, second % 60);
  RecordedEvent event;
  event.name = std::string(time) + "-alarm";
  event.trigger = second % 3 == 0 ? "line" : "alarm";
  event.triggered = time;
  event.part = second % 2 == 0 ? "Blade 7" : "ring";
  event.layer = second;
  return event;
}

class EventSearch : public testing::Test {
 protected:
  EventSearch() {
    for (int second = 0; second < 250; ++second) events.push_back(event_at(second));
  }
  /// Layers of the events that are found.
  std::vector<int> layers(const RecordingsQuery& query) const {
    std::vector<int> found;
    for (const RecordedEvent& event : search_events(events, query).events) {
      found.push_back(static_cast<int>(event.layer));
    }
    return found;
  }

  std::vector<RecordedEvent> events;
};

TEST_F(EventSearch, FindsEachOnceByPagesFromTheNewest) {
  RecordingsQuery query;
  std::vector<std::string> names;
  for (bool has_older = true; has_older;) {
    const RecordingsAnswer page = search_events(events, query);
    EXPECT_EQ(page.total, 250U);
    EXPECT_EQ(page.matching, 250U);
    ASSERT_LE(page.events.size(), 100U);
    for (const RecordedEvent& event : page.events) names.push_back(event.name);
    query.before = names.back();
    has_older = page.has_older;
  }
  ASSERT_EQ(names.size(), events.size());
  std::ranges::reverse(names);
  EXPECT_TRUE(std::ranges::equal(names, events, {}, {}, &RecordedEvent::name));
}

TEST_F(EventSearch, GoesOnAfterAnEventThatIsGone) {
  const RecordingsQuery query{.before = events[3].name, .limit = 2};
  events.erase(events.begin() + 3);
  EXPECT_THAT(layers(query), ElementsAre(2, 1));
}

TEST_F(EventSearch, TheLastPageSaysThatNoneIsOlder) {
  EXPECT_TRUE(search_events(events, {.limit = 249}).has_older);
  EXPECT_FALSE(search_events(events, {.limit = 250}).has_older);
  EXPECT_FALSE(search_events({}, {}).has_older);
}

TEST_F(EventSearch, MatchesCausePartAndLayer) {
  EXPECT_THAT(layers({.trigger = "line", .limit = 2}), ElementsAre(249, 246));
  EXPECT_THAT(layers({.part = "blade", .limit = 2}), ElementsAre(248, 246));
  EXPECT_EQ(search_events(events, {.part = "blade", .limit = 2}).matching, 125U);
  EXPECT_THAT(layers({.layer = 17}), ElementsAre(17));
  EXPECT_THAT(layers({.part = "blade", .layer = 17}), IsEmpty());
}

TEST_F(EventSearch, MomentsBelongToTheRangeInAnyForm) {
  EXPECT_THAT(layers({.from = "2026-11-28T12:00:03.125Z", .to = "2026-11-28T12:00:05.125000Z"}),
              ElementsAre(5, 4, 3));
  EXPECT_THAT(layers({.from = "2026-11-28T12:00:03.125000001Z", .to = "2026-11-28T12:00:05Z"}),
              ElementsAre(4));
}

TEST_F(EventSearch, AnEventWithoutATimeIsFoundOnlyWithoutARange) {
  events.resize(1);
  events[0].triggered.clear();
  EXPECT_EQ(search_events(events, {}).matching, 1U);
  EXPECT_EQ(search_events(events, {.from = "1970-01-01T00:00:01Z"}).matching, 0U);
  EXPECT_EQ(search_events(events, {.to = "2100-01-01T00:00:00Z"}).matching, 0U);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
