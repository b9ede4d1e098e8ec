// SPDX-License-Identifier: Apache-2.0
#include "app/recent_log.h"

#include <gmock/gmock.h>

namespace orbwatch::app {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> texts(const std::vector<RecentLog::Line>& lines) {
  std::vector<std::string> texts;
  for (const auto& line : lines) texts.push_back(line.text);
  return texts;
}

TEST(RecentLog, HasTheNewestLinesOldestFirst) {
  RecentLog log;
  EXPECT_THAT(log.newest({}), IsEmpty());
  log.add({LogLevel::Info, "one", {}});
  log.add({LogLevel::Error, "two", {.camera = "thermal", .fault = "stalled", .trigger = 7}});
  log.add({LogLevel::Warning, "three", {}});
  EXPECT_THAT(texts(log.newest({})), ElementsAre("one", "two", "three"));
  EXPECT_THAT(texts(log.newest({.most = 2})), ElementsAre("two", "three"));
  EXPECT_THAT(texts(log.newest({.least = LogLevel::Warning})), ElementsAre("two", "three"));
  EXPECT_THAT(texts(log.newest({.most = 1, .least = LogLevel::Error})), ElementsAre("two"));
  EXPECT_THAT(texts(log.newest({.after = 2})), ElementsAre("three"));
  EXPECT_THAT(log.newest({.after = 3}), IsEmpty());
  EXPECT_EQ(log.newest_number(), 3U);
  const RecentLog::Line two = log.newest({})[1];
  EXPECT_EQ(two.number, 2U);
  EXPECT_EQ(two.camera, "thermal");
  EXPECT_EQ(two.fault, "stalled");
  EXPECT_EQ(two.trigger, 7U);
}

TEST(RecentLog, IsBounded) {
  RecentLog log;
  const std::string text(3 * RecentLog::kMostText, 'x');
  constexpr std::size_t kMore = 5;
  for (std::size_t n = 0; n < RecentLog::kMostLines + kMore; ++n) {
    log.add({LogLevel::Info, text, {}});
  }
  const auto lines = log.newest({});
  ASSERT_EQ(lines.size(), RecentLog::kMostLines);
  EXPECT_EQ(lines.front().number, kMore + 1) << "the oldest are gone";
  EXPECT_EQ(lines.back().text.size(), RecentLog::kMostText);
}

}  // namespace
}  // namespace orbwatch::app
