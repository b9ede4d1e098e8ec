// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_archive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/ports/recorder/events/event_summary.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::recorder {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kName = "20261128T092200.125Z-layer";

class Archive : public testing::Test {
 protected:
  fs::path make(const std::string& name) const {
    fs::path event = folder_ / "events" / name;
    fs::create_directories(event);
    std::ofstream(event / kEventFile) << "recording";
    EventSummary summary;
    summary.trigger = "layer";
    summary.text = "the layer changed";
    summary.triggered = "2026-11-28T09:22:00.125Z";
    summary.part = "blade 7";
    summary.layer = 12;
    summary.pictures = {{"colour", 30}, {"thermal", 29}};
    summary.lost = 2;
    EXPECT_TRUE(write_summary(event, summary));
    return event;
  }

  const orbwatch::tests::TemporaryFolder folder_;
  EventArchive archive_{folder_.path()};
};

TEST_F(Archive, TellsWhatAnEventIs) {
  EXPECT_TRUE(archive_.list().value().empty()) << "no folder yet";
  const fs::path event = make(kName);
  const auto events = archive_.list();
  ASSERT_TRUE(events) << events.error().message;
  ASSERT_EQ(events->size(), 1U);
  const RecordedEvent& one = events->front();
  EXPECT_EQ(one.name, kName);
  EXPECT_EQ(one.trigger, "layer");
  EXPECT_EQ(one.part, "blade 7");
  EXPECT_EQ(one.layer, 12);
  EXPECT_EQ(one.pictures, 59U);
  EXPECT_EQ(one.lost, 2U);
  EXPECT_GT(one.bytes, 9U);
  EXPECT_TRUE(one.is_finished);
  EXPECT_EQ(archive_.recording(kName).value(), event / kEventFile);
  EXPECT_EQ(archive_.picture(kName).value(), event / kEventPicture);
}

TEST_F(Archive, PinsAndDeletes) {
  make(kName);
  ASSERT_TRUE(archive_.set_pinned(kName, true));
  EXPECT_TRUE(archive_.list()->front().is_pinned);
  ASSERT_TRUE(archive_.set_pinned(kName, false));
  EXPECT_FALSE(archive_.list()->front().is_pinned);
  ASSERT_TRUE(archive_.remove(kName));
  EXPECT_TRUE(archive_.list()->empty());
  EXPECT_THAT(archive_.remove(kName).error().message, HasSubstr("there is no event"));
}

TEST_F(Archive, LeavesAnEventThatIsBeingRecorded) {
  const fs::path event = make(kName + ".unfinished");
  EXPECT_FALSE(archive_.list()->front().is_finished);
  EXPECT_THAT(archive_.remove(kName).error().message, HasSubstr("is being recorded"));
  EXPECT_FALSE(archive_.set_pinned(kName, true));
  EXPECT_FALSE(archive_.recording(kName));
  EXPECT_TRUE(fs::exists(event / kEventFile));
}

TEST_F(Archive, RefusesNamesThatLeaveTheFolder) {
  make(kName);
  for (const std::string& name : {"../events/" + kName, std::string(".."), std::string()}) {
    EXPECT_THAT(archive_.recording(name).error().message, HasSubstr("is not the name of an event"));
    EXPECT_FALSE(archive_.remove(name));
  }
  EXPECT_EQ(archive_.list()->size(), 1U);
}

TEST_F(Archive, ListsAnEventWhoseSummaryIsDamaged) {
  std::ofstream(make(kName) / kEventSummary) << "{";
  const auto events = archive_.list();
  ASSERT_TRUE(events);
  EXPECT_EQ(events->front().name, kName);
  EXPECT_THAT(events->front().text, HasSubstr(kEventSummary));
  EXPECT_TRUE(archive_.remove(kName));
}

}  // namespace
}  // namespace orbwatch::app::recorder
