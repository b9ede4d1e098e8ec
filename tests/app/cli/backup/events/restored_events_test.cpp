// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/events/restored_events.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/archive/compression.h"
#include "app/cli/archive/tar.h"
#include "hal/thread/file_descriptor.h"
#include "tests/app/cli/backup/events/recorded_events.h"
#include "tests/support/service_user.h"

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class RestoredEvents : public EventsOfADevice {
 protected:
  static std::string frame_of(const Archive& archive) {
    return tar_of(archive, {})
        .and_then([](const std::string& tar) { return compressed(tar); })
        .value_or("");
  }
  /// Restores frames on the new device; returns the reason against it. Checking says the same.
  std::string place(const std::string& bytes, const std::vector<ManifestEvent>& events,
                    std::uint64_t reserve = 0) {
    FrameReader checked = frames_of(bytes), frames = frames_of(bytes);
    if (!checked.next().value_or(false) || !frames.next().value_or(false)) return "no frame";
    const EventPlace place{folder / "new", reserve};
    const auto right = check_frames(checked, events, place);
    DiskChanges disk;
    const auto placed = place_events(frames, events, place, disk);
    EXPECT_EQ(right ? "" : right.error().message, placed ? "" : placed.error().message);
    return placed ? "" : placed.error().message;
  }
  /// Names below the events of the new device.
  std::vector<std::string> restored() const {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder / "new/events", none)) {
      names.push_back(entry.path().filename().string());
    }
    std::ranges::sort(names);
    return names;
  }
};

TEST_F(RestoredEvents, AreRestoredWithAllTheirFiles) {
  const auto events = manifest_events(kept());
  EXPECT_THAT(events, ElementsAre(ManifestEvent{kFirst, 300'009}, ManifestEvent{kSecond, 512}));
  EXPECT_EQ(missing_events(events, {folder / "new", 0}).size(), 2U);
  EXPECT_EQ(place(frame(), events), "");
  EXPECT_THAT(restored(), ElementsAre(kFirst, kSecond));
  for (const char* event : {kFirst, kSecond}) {
    FileStates was = states_below(old / event), is = states_below(folder / "new/events" / event);
    for (auto* states : {&was, &is}) {
      for (auto& [name, state] : *states) state.second = 0;  // the mode is that of the folder
    }
    EXPECT_EQ(is, was);
  }
  EXPECT_TRUE(missing_events(events, {folder / "new", 0}).empty());
}

TEST_F(RestoredEvents, ThatAreThereStayAsTheyAre) {
  write_file(folder / "new/events" / kFirst / recorder::kEventFile, "another");
  EXPECT_EQ(place(frame(), manifest_events(kept())), "");
  EXPECT_EQ(states_below(folder / "new/events" / kFirst).at(recorder::kEventFile).first, "another");
  EXPECT_THAT(restored(), ElementsAre(kFirst, kSecond));
}

TEST_F(RestoredEvents, OfAFrameThatIsCutOffAppearAsAWholeOrNotAtAll) {
  const std::string whole = frame();
  const auto events = manifest_events(kept());
  for (std::size_t size = 1; size < whole.size(); ++size) {
    EXPECT_NE(place(whole.substr(0, size), events), "") << size;
    for (const std::string& name : restored()) {
      const auto states = states_below(folder / "new/events" / name);
      EXPECT_EQ(states.size(), states_below(old / name).size()) << name;
    }
    fs::remove_all(folder / "new/events");
  }
}

TEST_F(RestoredEvents, OfAnotherFormAreRefused) {
  const std::string event = std::string("events/") + kFirst + "/";
  const std::vector<ManifestEvent> stated{{kFirst, 4}};
  const ArchivedFile recording{event + recorder::kEventFile, "mcap"};
  ASSERT_EQ(place(frame_of({recording}), stated), "");
  fs::remove_all(folder / "new/events");
  const std::vector<Archive> wrong{
      {},
      {{event + recorder::kEventFile, "mca"}},
      {{event + recorder::kEventFile, "mcap."}},
      {{event + recorder::kEventSummary, "json"}},
      {{event + "other.txt", "mcap"}},
      {{event + "sub/event.mcap", "mcap"}},
      {{std::string("events/") + kSecond + "/event.mcap", "mcap"}},
      {{"event.mcap", "mcap"}},
      {recording, {event + recorder::kEventPicture, "x"}},
      {recording, {std::string("events/") + kSecond + "/event.mcap", ""}},
      {{event + recorder::kEventPin, ""}, {event + recorder::kEventPin, ""}, recording}};
  for (std::size_t n = 0; n < wrong.size(); ++n) {
    EXPECT_THAT(place(frame_of(wrong[n]), stated), HasSubstr("damaged")) << n;
    fs::remove_all(folder / "new/events");
  }
  EXPECT_THAT(place(frame_of({recording}) + frame_of({recording}), stated), HasSubstr("damaged"));
}

TEST(RestoredEventsList, HasNamesOfEventsInOrderAndOnceEach) {
  EXPECT_TRUE(check_events({}));
  EXPECT_TRUE(check_events({{kFirst, 1}, {kSecond, 1}}));
  EXPECT_FALSE(check_events({{kSecond, 1}, {kFirst, 1}}));
  EXPECT_FALSE(check_events({{kFirst, 1}, {kFirst, 1}}));
  for (const char* name : {"", "..", "../../etc", "20261128T092200.125Z-alarm/..", "a/b",
                           "20261128T092200.125Z-alarm.unfinished"}) {
    EXPECT_FALSE(check_events({{name, 1}})) << name;
  }
}

TEST_F(RestoredEvents, LeaveTheReserveOfTheDisk) {
  EXPECT_THAT(place(frame(), manifest_events(kept()), std::uint64_t{1} << 60),
              HasSubstr("has no room for the events: 1099511627777 MiB are needed"));
  EXPECT_THAT(place(frame(), {{kFirst, ~std::uint64_t{0}}, {kSecond, 1}}), HasSubstr("too large"));
  EXPECT_THAT(restored(), ElementsAre());
}

TEST_F(RestoredEvents, AppearOnlyWhenTheirChecksumIsRight) {
  std::string bytes = frame();
  bytes[200] = static_cast<char>(bytes[200] ^ 1);
  EXPECT_NE(place(bytes, manifest_events(kept())), "");
  EXPECT_THAT(restored(), ElementsAre());
  EXPECT_EQ(place(frame(), manifest_events(kept())), "");
}

TEST_F(RestoredEvents, BelongToTheOwnerOfTheRecordingsAndAreWrittenWithItsRights) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  fs::permissions(folder.path(), fs::perms(0755));
  tests::give_to_service(folder / "new");
  EXPECT_EQ(place(frame(), manifest_events(kept())), "");
  struct stat about {};
  ASSERT_EQ(::stat((folder / "new/events" / kFirst / recorder::kEventFile).c_str(), &about), 0);
  EXPECT_EQ(about.st_uid, tests::kService);
  EXPECT_EQ(about.st_gid, tests::kService);

  fs::remove_all(folder / "new/events");
  fs::create_directories(folder / "of-root");
  fs::create_directory_symlink(folder / "of-root", folder / "new/events");
  FrameReader frames = frames_of(frame());
  ASSERT_TRUE(frames.next().value_or(false));
  DiskChanges disk;
  const auto led = place_events(frames, manifest_events(kept()), {folder / "new", 0}, disk);
  ASSERT_FALSE(led);
  EXPECT_THAT(led.error().message, HasSubstr("Permission denied"));
  EXPECT_TRUE(fs::is_empty(folder / "of-root"));
}

TEST_F(RestoredEvents, OfASecondRestoreWaitForTheFirst) {
  const auto events = manifest_events(kept());
  const auto placed = [&] {
    FrameReader frames = frames_of(frame());
    EXPECT_TRUE(frames.next().value_or(false));
    DiskChanges disk;
    const auto done = place_events(frames, events, {folder / "new", 0}, disk);
    return done ? "" : done.error().message;
  };
  fs::create_directories(folder / "new/events");
  {
    const hal::FileDescriptor first(
        ::open((folder / "new/events").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    ASSERT_EQ(::flock(first.get(), LOCK_EX), 0);
    EXPECT_THAT(placed(), HasSubstr("another restore adds events; repeat this one afterwards"));
    EXPECT_THAT(restored(), ElementsAre());
  }
  EXPECT_EQ(placed(), "");
  EXPECT_THAT(restored(), ElementsAre(kFirst, kSecond));
}

TEST_F(RestoredEvents, MayHaveMissingFoldersAboveThem) {
  fs::remove_all(folder / "new");
  FrameReader frames = frames_of(frame());
  ASSERT_TRUE(frames.next().value_or(false));
  DiskChanges disk;
  const EventPlace deeper{folder / "new/a/b", 0};
  const auto placed = place_events(frames, manifest_events(kept()), deeper, disk);
  EXPECT_TRUE(placed) << placed.error().message;
  EXPECT_TRUE(fs::exists(folder / "new/a/b/events" / kFirst / recorder::kEventFile));
}

}  // namespace
}  // namespace orbwatch::app::cli::backup
