// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/events/kept_events.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/cli/backup/events/recorded_events.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using KeptEvents = EventsOfADevice;

TEST_F(KeptEvents, ThatChangeMeanwhileEndTheBackup) {
  const auto events = kept();
  const auto stated = manifest_events(events);
  const auto refusal = [&] {
    const auto written = write_events(events, stated, [](std::string_view) { return Result<>(); });
    return written ? "" : written.error().message;
  };
  EXPECT_EQ(refusal(), "");
  write_file(old / kFirst / recorder::kEventSummary, "{ }");
  EXPECT_THAT(refusal(), HasSubstr("was changed meanwhile; try again"));
  write_file(old / kFirst / recorder::kEventSummary, "{}");
  fs::remove(old / kSecond / recorder::kEventFile);
  EXPECT_THAT(refusal(), HasSubstr("was changed meanwhile"));
  fs::create_directory(old / kSecond / recorder::kEventFile);
  EXPECT_THAT(refusal(), HasSubstr("is not a regular file"));
}

TEST_F(KeptEvents, WithoutARecordingAreLeftOut) {
  fs::remove(old / kSecond / recorder::kEventFile);
  std::vector<std::string> left_out;
  const auto events = kept_events(listed(), left_out);
  ASSERT_TRUE(events);
  EXPECT_EQ(events->size(), 1U);
  EXPECT_THAT(left_out, ElementsAre(HasSubstr("has no event.mcap")));
}

TEST_F(KeptEvents, ThatWereRemovedMeanwhileAreLeftOut) {
  const auto all = listed();
  fs::remove_all(old / kSecond);
  std::vector<std::string> left_out;
  const auto events = kept_events(all, left_out);
  ASSERT_TRUE(events) << events.error().message;
  ASSERT_EQ(events->size(), 1U);
  EXPECT_EQ(events->front().name, kFirst);
  EXPECT_THAT(left_out, ElementsAre());
}

TEST(KeptEventsList, IsEmptyWithoutRecordings) {
  std::vector<std::string> left_out;
  auto none = recorder::EventFolder("/nonexistent/recordings").list();
  ASSERT_TRUE(none) << none.error().message;
  EXPECT_EQ(kept_events(std::move(*none), left_out)->size(), 0U);
}

}  // namespace
}  // namespace orbwatch::app::cli::backup
