// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "app/ports/recorder/events/event_archive.h"
#include "app/ports/recorder/events/event_name.h"
#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/recorder_sink.h"
#include "app/ports/recorder/recording_folder.h"
#include "hal/mcap/file.h"
#include "tests/app/ports/recorder/events/read_event.h"
#include "tests/app/ports/recorder/events/recorded_machine.h"
#include "tests/support/service_user.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::recorder {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using tests::RecordedMachine;

const Utc kNow = std::chrono::sys_days(std::chrono::year(2026) / 1 / 10);

class StoredEvents : public testing::Test {
 protected:
  RecorderSettings settings() const {
    EventSettings events;
    events.ring_mib = 1;
    events.before = events.after = milliseconds(50);
    events.longest = milliseconds(300);
    return {.folder = folder_.path(), .events = events};
  }

  /// A finished event of these bytes on the disk.
  void make_event(const std::string& name, std::uintmax_t bytes, bool is_pinned = false) const {
    const fs::path folder = folder_ / "events" / name;
    fs::create_directories(folder);
    std::ofstream(folder / kEventFile) << "x";
    fs::resize_file(folder / kEventFile, bytes);
    if (is_pinned) std::ofstream(folder / kEventPin) << "";
  }
  bool has(const std::string& name) const { return fs::exists(folder_ / "events" / name); }

  /// Makes room by a clock that has been right for an hour.
  static Result<int> make_room_by_age(RecordingFolder& folder, Utc utc) {
    const hal::TimePoint now = hal::Clock::now();
    EXPECT_EQ(folder.make_room({}, utc - std::chrono::hours(1), now), 0);
    return folder.make_room({}, utc, now + std::chrono::hours(1));
  }

  /// An event whose recorder was killed after some pictures; returns its name.
  std::string make_cut_event() const {
    RecordedMachine machine(settings());
    for (std::uint64_t n = 1; n <= 20; ++n) machine.pass(n, n == 10);
    for (int round = 0; round < 4; ++round) EXPECT_TRUE(machine.record());
    EXPECT_TRUE(machine.recorder().flush());
    machine.recorder().give_up();
    const auto events = machine.events();
    EXPECT_EQ(events.size(), 1U);
    return events.empty() ? std::string() : events.front().name;
  }

  const orbwatch::tests::TemporaryFolder folder_;
};

TEST(EventName, IsMomentAndTriggerAndNothingElse) {
  const Utc moment = std::chrono::sys_days(std::chrono::year(2026) / 11 / 28) +
                     std::chrono::hours(9) + milliseconds(125);
  EXPECT_EQ(event_name(moment, TriggerKind::Laser), "20261128T090000.125Z-laser_on");
  for (const TriggerKind kind : kTriggerKinds) EXPECT_TRUE(is_event_name(event_name(moment, kind)));
  EXPECT_TRUE(is_event_name("20261128T090000.125Z-alarm-2"));
  for (const char* const name :
       {"", "..", "../20261128T090000.125Z-alarm", "20261128T090000.125Z-alarm/..",
        "20261128T090000.125Z-", "20261128T090000.125Z-alarm-", "20261128T090000.125Z-alarm-x",
        "20261128T090000.125Z-other", "2026x128T090000.125Z-alarm",
        "20261128T090000.125Z-alarm2"}) {
    EXPECT_FALSE(is_event_name(name)) << name;
  }
}

TEST_F(StoredEvents, NamesThatLeaveTheFolderAreRefused) {
  make_event("20261128T090000.000Z-alarm", 10);
  std::ofstream(folder_ / "secret") << "x";
  const EventFolder folder(folder_.path());
  EXPECT_TRUE(folder.find("20261128T090000.000Z-alarm"));
  for (const char* const name : {"../secret", "..", ".", "", "events/../..", "/etc"}) {
    const auto found = folder.find(name);
    ASSERT_FALSE(found) << name;
    EXPECT_THAT(found.error().message, testing::HasSubstr("is not the name of an event"));
  }
  EXPECT_FALSE(folder.find("20261128T090000.000Z-layer"));
}

TEST_F(StoredEvents, PinnedOnesStayAndTheOldestOtherGoesFirst) {
  constexpr std::uintmax_t kBig = std::uintmax_t{100} << 20;
  make_event("20260101T000000.000Z-alarm", kBig, true);
  make_event("20260102T000000.000Z-alarm", kBig);
  make_event("20260104T000000.000Z-alarm", kBig);
  std::ofstream(folder_ / "log-20260103T000000Z.mcap") << "x";
  fs::resize_file(folder_ / "log-20260103T000000Z.mcap", kBig);
  RecorderSettings small = settings();
  small.limit_mib = 256;
  RecordingFolder folder(small);
  EXPECT_EQ(folder.make_room({}, kNow), 2);
  EXPECT_TRUE(has("20260101T000000.000Z-alarm"));
  EXPECT_FALSE(has("20260102T000000.000Z-alarm"));
  EXPECT_FALSE(fs::exists(folder_ / "log-20260103T000000Z.mcap"));
  EXPECT_TRUE(has("20260104T000000.000Z-alarm"));
}

TEST_F(StoredEvents, APinThatNobodyNoticedStillCounts) {
  constexpr std::uintmax_t kBig = std::uintmax_t{200} << 20;
  make_event("20260101T000000.000Z-alarm", kBig);
  const fs::path first = folder_ / "events" / "20260101T000000.000Z-alarm";
  const auto before = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(first, before);
  RecorderSettings small = settings();
  small.limit_mib = 256;
  RecordingFolder folder(small);
  ASSERT_EQ(folder.make_room({}, kNow), 0);
  std::ofstream(first / kEventPin) << "";
  fs::last_write_time(first, before);
  make_event("20260102T000000.000Z-alarm", kBig);
  make_event("20260103T000000.000Z-alarm", 10);
  EXPECT_EQ(folder.make_room({}, kNow), 1);
  EXPECT_TRUE(has("20260101T000000.000Z-alarm"));
  EXPECT_FALSE(has("20260102T000000.000Z-alarm"));
}

TEST_F(StoredEvents, APinAfterTheDecisionToDeleteStillCounts) {
  make_event("20260101T000000.000Z-alarm", 10);
  const EventFolder folder(folder_.path());
  const auto decided = folder.find("20260101T000000.000Z-alarm");
  ASSERT_TRUE(decided);
  ASSERT_TRUE(EventFolder::set_pinned(*decided, true));
  EXPECT_EQ(folder.remove_unless_pinned(*decided), false);
  const auto event = folder.find(decided->name);
  ASSERT_TRUE(event) << event.error().message;
  EXPECT_TRUE(event->is_pinned);
  EXPECT_TRUE(fs::exists(event->folder / kEventFile));
  ASSERT_TRUE(EventFolder::set_pinned(*event, false));
  EXPECT_EQ(folder.remove_unless_pinned(*decided), true);
  EXPECT_FALSE(EventFolder::set_pinned(*decided, true)) << "it is deleted";
  EXPECT_TRUE(folder.list()->empty());
}

TEST_F(StoredEvents, PinnedOnesLeaveNewOnesAQuarterOfTheLimit) {
  make_event("20260101T000000.000Z-alarm", std::uintmax_t{300} << 20, true);
  make_event("20260108T000000.000Z-alarm", std::uintmax_t{40} << 20);
  make_event("20260109T000000.000Z-alarm", std::uintmax_t{20} << 20);
  make_event("20260109T230000.000Z-alarm", std::uintmax_t{10} << 20);
  RecorderSettings small = settings();
  small.limit_mib = 256;
  RecordingFolder folder(small);
  EXPECT_EQ(folder.make_room({}, kNow), 1);
  EXPECT_FALSE(has("20260108T000000.000Z-alarm"));
  EXPECT_TRUE(has("20260109T000000.000Z-alarm"));
  EXPECT_TRUE(has("20260109T230000.000Z-alarm"));
  EXPECT_THAT(folder.pin_fault(), testing::HasSubstr("pinned events take 300 MiB of limit_mib"));

  make_event("20260109T235900.000Z-alarm", std::uintmax_t{100} << 20);  // more than a quarter
  EXPECT_EQ(folder.make_room({}, kNow), 2);
  EXPECT_EQ(folder.make_room({}, kNow), 0);
  EXPECT_TRUE(has("20260101T000000.000Z-alarm"));
  EXPECT_TRUE(has("20260109T235900.000Z-alarm")) << "the newest";

  const auto pinned = EventFolder(folder_.path()).find("20260101T000000.000Z-alarm");
  ASSERT_TRUE(pinned);
  ASSERT_TRUE(EventFolder::set_pinned(*pinned, false));
  EXPECT_EQ(folder.make_room({}, kNow), 1);
  EXPECT_FALSE(has("20260101T000000.000Z-alarm"));
  EXPECT_EQ(folder.pin_fault(), "");
}

TEST_F(StoredEvents, PinnedOnesThatFillTheLimitAreAFaultBesideWhichRecordingGoesOn) {
  make_event("20260101T000000.000Z-alarm", std::uintmax_t{300} << 20, true);
  RecorderSettings small = settings();
  small.limit_mib = 256;
  small.events.reset();
  RecorderSink sink(small, {}, {});
  ASSERT_TRUE(sink.start());
  Status status;
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (sink.statistics().recorded == 0 && std::chrono::steady_clock::now() < give_up) {
    ++status.frame_set;
    status.stamp = hal::Clock::now();
    sink.accept(status);
    std::this_thread::sleep_for(milliseconds(2));  // polls another thread
  }
  EXPECT_GT(sink.statistics().recorded, 0U);
  EXPECT_TRUE(sink.statistics().fault);
  EXPECT_TRUE(sink.works()) << "it records, so an update on trial is kept";
}

TEST_F(StoredEvents, NamesInTheFutureGoFirstAndTheOldestOfThemBeforeTheOthers) {
  constexpr std::uintmax_t kBig = std::uintmax_t{100} << 20;
  for (const char* name : {"20260108T000000.000Z-alarm", "20260110T000030.000Z-alarm",
                           "20360101T000000.000Z-alarm", "20370101T000000.000Z-alarm"}) {
    make_event(name, kBig);
  }
  std::ofstream(folder_ / "log-20360601T000000Z.mcap") << "x";
  fs::resize_file(folder_ / "log-20360601T000000Z.mcap", kBig);
  RecorderSettings small = settings();
  small.limit_mib = 300;
  RecordingFolder folder(small);
  EXPECT_EQ(folder.make_room({}, kNow), 2);
  EXPECT_FALSE(has("20360101T000000.000Z-alarm"));
  EXPECT_FALSE(fs::exists(folder_ / "log-20360601T000000Z.mcap"));
  EXPECT_TRUE(has("20370101T000000.000Z-alarm"));
  EXPECT_TRUE(has("20260108T000000.000Z-alarm"));
  make_event("20260109T000000.000Z-alarm", 2 * kBig);
  EXPECT_EQ(folder.make_room({}, kNow), 2);
  EXPECT_FALSE(has("20370101T000000.000Z-alarm"));
  EXPECT_FALSE(has("20260108T000000.000Z-alarm"));
  EXPECT_TRUE(has("20260110T000030.000Z-alarm")) << "half a minute ahead is not the future";
}

TEST_F(StoredEvents, AClockThatIsSetBackByAnHourLeavesTheNewest) {
  constexpr std::uintmax_t kBig = std::uintmax_t{100} << 20;
  for (const char* name :
       {"20260101T000000.000Z-alarm", "20260109T233000.000Z-alarm", "20260110T003000.000Z-alarm"}) {
    make_event(name, kBig);
  }
  RecorderSettings small = settings();
  small.limit_mib = 256;
  RecordingFolder folder(small);
  EXPECT_EQ(folder.make_room({}, kNow), 1);
  EXPECT_FALSE(has("20260101T000000.000Z-alarm"));
  EXPECT_TRUE(has("20260109T233000.000Z-alarm"));
  EXPECT_TRUE(has("20260110T003000.000Z-alarm"));
}

TEST_F(StoredEvents, OneAboveTheAgeGoesUnlessItIsPinned) {
  make_event("20260107T235959.999Z-alarm", 10);
  make_event("20260107T235959.999Z-layer", 10, true);
  make_event("20260107T235959.999Z-command.unfinished", 10);
  make_event("20260108T000000.000Z-alarm", 10);
  make_event("20260111T000000.000Z-alarm", 10);  // before the clock was set back
  RecorderSettings aged = settings();
  RecordingFolder endless(aged);
  EXPECT_EQ(endless.make_room({}, kNow), 0);
  aged.events->keep_days = 2;
  RecordingFolder folder(aged);
  EXPECT_EQ(make_room_by_age(folder, kNow - std::chrono::days(1)), 0) << "the clock was set back";
  EXPECT_EQ(make_room_by_age(folder, Utc() + std::chrono::days(1)), 0)
      << "and has lost its battery";
  EXPECT_EQ(make_room_by_age(folder, kNow), 1);
  EXPECT_FALSE(has("20260107T235959.999Z-alarm"));
  EXPECT_TRUE(has("20260107T235959.999Z-layer"));
  EXPECT_TRUE(has("20260107T235959.999Z-command.unfinished"));
  EXPECT_TRUE(has("20260108T000000.000Z-alarm"));
  EXPECT_EQ(make_room_by_age(folder, kNow + milliseconds(1)), 1);
  EXPECT_FALSE(has("20260108T000000.000Z-alarm"));
  EXPECT_TRUE(has("20260111T000000.000Z-alarm"));
}

TEST_F(StoredEvents, AClockThatIsBrieflyAheadDeletesNothingByAge) {
  using std::chrono::hours, std::chrono::minutes;
  make_event("20260109T000000.000Z-alarm", 10);
  RecorderSettings aged = settings();
  aged.events->keep_days = 2;
  RecordingFolder folder(aged);
  const hal::TimePoint start = hal::Clock::now();
  const Utc ahead = kNow + std::chrono::years(70);
  EXPECT_EQ(folder.make_room({}, ahead, start), 0);
  EXPECT_EQ(folder.make_room({}, ahead + minutes(59), start + minutes(59)), 0);
  EXPECT_EQ(folder.make_room({}, kNow, start + hours(1)), 0) << "it is corrected";
  EXPECT_EQ(folder.make_room({}, kNow + hours(2), start + hours(3)), 0);
  EXPECT_EQ(folder.make_room({}, ahead, start + hours(3)), 0) << "it steps after hours";
  EXPECT_EQ(folder.make_room({}, ahead + minutes(59), start + hours(3) + minutes(59)), 0);
  EXPECT_TRUE(has("20260109T000000.000Z-alarm"));
  const Utc slewed = ahead + hours(1) + std::chrono::seconds(30);
  EXPECT_EQ(folder.make_room({}, slewed, start + hours(4)), 1) << "it is right by now";
}

TEST_F(StoredEvents, ManyAboveTheAgeGoAFewAtATime) {
  for (int n = 0; n < 25; ++n) {
    make_event("20260101T0000" + std::to_string(10 + n) + ".000Z-alarm", 10);
  }
  RecorderSettings aged = settings();
  aged.events->keep_days = 1;
  RecordingFolder folder(aged);
  int removed = 0;
  for (const int expected : {10, 10, 5, 0}) {
    EXPECT_EQ(make_room_by_age(folder, kNow), expected);
    removed += expected;
    EXPECT_EQ(EventFolder(folder_.path()).list()->size(), static_cast<std::size_t>(25 - removed));
  }
}

TEST_F(StoredEvents, OneThatCannotBeDeletedLeavesThatToTheNextOnes) {
  constexpr std::uintmax_t kBig = std::uintmax_t{200} << 20;
  for (const char* name :
       {"20260101T000000.000Z-alarm", "20260102T000000.000Z-alarm", "20260103T000000.000Z-alarm"}) {
    make_event(name, kBig);
  }
  make_event("20260101T000000.000Z-alarm.deleted", 1);  // in its way
  RecorderSettings small = settings();
  small.limit_mib = 256;
  RecordingFolder folder(small);
  EXPECT_EQ(folder.make_room({}, kNow), 1);
  EXPECT_TRUE(has("20260101T000000.000Z-alarm"));
  EXPECT_FALSE(has("20260102T000000.000Z-alarm"));
  fs::remove_all(folder_ / "events/20260101T000000.000Z-alarm.deleted");
  EXPECT_EQ(folder.make_room({}, kNow), 1) << "it is tried again";
  EXPECT_FALSE(has("20260101T000000.000Z-alarm"));
  EXPECT_TRUE(has("20260103T000000.000Z-alarm"));
}

TEST_F(StoredEvents, ADeletionThatCannotBeEndedStopsNoRecording) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  make_event("20260101T000000.000Z-alarm.deleted", 1);
  make_event("20260102T000000.000Z-alarm.unfinished", 1);
  // The deleted event keeps root as its owner, like one that an administrator copied there.
  fs::permissions(folder_.path(), fs::perms(0755));
  orbwatch::tests::give_to_service(folder_ / "events");
  orbwatch::tests::give_to_service(folder_ / "events/20260102T000000.000Z-alarm.unfinished");
  const auto prepares = [this] {
    EventFolder folder(folder_.path());
    return folder.prepare() && folder.prepare();
  };
  EXPECT_TRUE(orbwatch::tests::as_service(022, prepares));
  EXPECT_TRUE(has("20260101T000000.000Z-alarm.deleted"));
  EXPECT_FALSE(has("20260102T000000.000Z-alarm.unfinished")) << "it has no summary";
}

TEST_F(StoredEvents, ADeletionThatWasInterruptedKeepsAPinnedEvent) {
  make_event("20260101T000000.000Z-alarm.deleted", 10, true);
  make_event("20260102T000000.000Z-alarm.deleted", 10);
  EventFolder folder(folder_.path());
  ASSERT_TRUE(folder.prepare());
  const auto event = folder.find("20260101T000000.000Z-alarm");
  ASSERT_TRUE(event) << event.error().message;
  EXPECT_TRUE(event->is_pinned);
  EXPECT_TRUE(fs::exists(event->folder / kEventFile));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST_F(StoredEvents, ADeletionOnRequestBeginsWithThePin) {
  make_event("20260101T000000.000Z-alarm", 10);
  // A folder that is not empty cannot be removed as a pin.
  fs::create_directories(folder_ / "events/20260101T000000.000Z-alarm" / kEventPin / "in_the_way");
  EventFolder folder(folder_.path());
  const auto event = folder.find("20260101T000000.000Z-alarm");
  ASSERT_TRUE(event);
  EXPECT_FALSE(folder.remove(*event));
  ASSERT_TRUE(folder.prepare());
  EXPECT_TRUE(fs::exists(event->folder / kEventFile)) << "nothing was deleted before the pin";
  fs::remove(event->folder / kEventPin / "in_the_way");
  EXPECT_TRUE(folder.remove(*event));
  EXPECT_TRUE(folder.list()->empty());
}

TEST_F(StoredEvents, APinIsSetAndRemoved) {
  make_event("20261128T090000.000Z-alarm", 10);
  const EventFolder folder(folder_.path());
  const auto event = folder.find("20261128T090000.000Z-alarm");
  ASSERT_TRUE(event);
  EXPECT_FALSE(event->is_pinned);
  ASSERT_TRUE(EventFolder::set_pinned(*event, true));
  EXPECT_TRUE(folder.find(event->name)->is_pinned);
  ASSERT_TRUE(EventFolder::set_pinned(*event, false));
  EXPECT_FALSE(folder.find(event->name)->is_pinned);
  ASSERT_TRUE(folder.remove(*event));
  EXPECT_TRUE(folder.list()->empty());
  EXPECT_FALSE(has("20261128T090000.000Z-alarm"));
}

TEST_F(StoredEvents, OneThatCannotBeFinishedIsTriedAgain) {
  const std::string name = make_cut_event();
  RecordingFolder folder(settings());
  {
    const auto other = hal::mcap::File::open(
        folder_ / "events" / (name + ".unfinished") / kEventFile, hal::mcap::File::Access::Change);
    ASSERT_TRUE(other);
    ASSERT_TRUE(folder.prepare());
    EXPECT_FALSE(has(name));
  }
  ASSERT_TRUE(folder.prepare());
  EXPECT_TRUE(has(name));
}

TEST_F(StoredEvents, OneThatItsRecorderLeftMayBeDeleted) {
  const std::string name = make_cut_event();
  const fs::path file = folder_ / "events" / (name + ".unfinished") / kEventFile;
  EventArchive archive(folder_.path());
  EXPECT_THAT(archive.remove(name).error().message, testing::HasSubstr("is being recorded"));
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
  {
    const auto recorder = hal::mcap::File::open(file, hal::mcap::File::Access::Change);
    ASSERT_TRUE(recorder);
    EXPECT_THAT(archive.remove(name).error().message, testing::HasSubstr("is being recorded"));
  }
  EXPECT_THAT(archive.recording(name).error().message,
              testing::HasSubstr("was not recorded to its end"));
  EXPECT_TRUE(archive.remove(name));
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(StoredEvents, OneWhoseFileCannotBeOpenedMayBeRecorded) {
  const std::string name = make_cut_event();
  const fs::path file = folder_ / "events" / (name + ".unfinished") / kEventFile;
  fs::remove(file);
  fs::create_directory(file);  // an error other than that it is being written
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
  EventArchive archive(folder_.path());
  const auto refused = archive.remove(name);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("is being recorded"));
  EXPECT_TRUE(fs::exists(file));
}

TEST_F(StoredEvents, AnEventThatWasCutIsFinishedAtTheNextStart) {
  RecordedMachine machine(settings());
  for (std::uint64_t n = 1; n <= 20; ++n) machine.pass(n, n == 10);
  ASSERT_TRUE(machine.record());
  for (int round = 0; round < 3; ++round) ASSERT_TRUE(machine.record());
  ASSERT_TRUE(machine.recorder().flush());
  const auto running = machine.events();
  ASSERT_EQ(running.size(), 1U);
  ASSERT_FALSE(running.front().is_finished);

  // The disk's content as after a power failure now, with a torn record.
  const orbwatch::tests::TemporaryFolder after;
  const std::string name = running.front().folder.filename();
  fs::create_directories(after / "events");
  fs::copy(running.front().folder, after.path() / "events" / name);
  const fs::path torn = after.path() / "events" / name / kEventFile;
  std::ofstream(torn, std::ios::app) << "torn";
  fs::create_directories(after.path() / "events" / "20261128T090000.000Z-layer.unfinished");
  fs::create_directories(after.path() / "events" / "20261128T090000.000Z-layer.deleted");

  EventFolder folder(after.path());
  ASSERT_TRUE(folder.prepare());
  const auto events = folder.list();
  ASSERT_TRUE(events);
  ASSERT_EQ(events->size(), 1U) << "an event without a recording is deleted";
  EXPECT_TRUE(events->front().is_finished);
  EXPECT_EQ(events->front().name, running.front().name);
  const auto summary = read_summary(events->front().folder);
  ASSERT_TRUE(summary) << summary.error().message;
  EXPECT_TRUE(summary->is_interrupted);
  auto topics = tests::read_recording(events->front().folder / kEventFile);
  EXPECT_EQ(topics["/orbwatch/thermal/image_raw"].size(), summary->pictures.front().second);
  EXPECT_GT(summary->pictures.front().second, 0U);
  EXPECT_EQ(std::distance(fs::directory_iterator(after / "events"), {}), 1);
}

}  // namespace
}  // namespace orbwatch::app::recorder
