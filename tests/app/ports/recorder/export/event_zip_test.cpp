// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/event_zip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/ports/recorder/export/copied_range.h"
#include "app/ports/recorder/export/state_table.h"
#include "app/ports/recorder/export/zip_writer.h"
#include "tests/app/ports/recorder/export/recorded_event.h"
#include "tests/support/subprocess.h"

/// ZIP of an event, read by Python.
namespace orbwatch::app::recorder {
namespace {

using testing::HasSubstr;

class EventZip : public tests::RecordedEventTest {
 protected:
  std::filesystem::path event() const { return recording.parent_path(); }
  /// Unpacks the archive, which checks all checksums.
  std::filesystem::path unpacked() const {
    tests::Subprocess python({"/usr/bin/python3", "-m", "zipfile", "-e", zip_, folder / "unpacked"},
                             folder / "said");
    EXPECT_EQ(python.wait(), 0) << python.output();
    return folder / "unpacked" / event().filename();
  }

  const std::filesystem::path zip_ = folder / "event.zip";
};

TEST_F(EventZip, HasTheFilesOfTheRangeAndTheEvent) {
  const StampRange range = stamps(numbers(sets[2], sets[7]));
  const auto done = write_event_zip(event(), range, zip_, go_on);
  ASSERT_TRUE(done) << done.error().message;
  const auto files = unpacked();
  ASSERT_TRUE(copy_range(recording, range, folder / "copy.mcap", go_on));
  ASSERT_TRUE(write_state_table(recording, range, folder / "states.csv", go_on));
  EXPECT_EQ(tests::text_in(files / "event.mcap"), tests::text_in(folder / "copy.mcap"));
  EXPECT_EQ(tests::text_in(files / "states.csv"), tests::text_in(folder / "states.csv"));
  EXPECT_EQ(tests::text_in(files / "summary.json"), tests::text_in(event() / "summary.json"));
  ASSERT_TRUE(std::filesystem::exists(event() / "trigger.jpg"));
  EXPECT_EQ(tests::text_in(files / "trigger.jpg"), tests::text_in(event() / "trigger.jpg"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(files), {}), 4);
}

TEST_F(EventZip, NeedsNoPictureOfTheTrigger) {
  std::filesystem::remove(event() / "trigger.jpg");
  ASSERT_TRUE(write_event_zip(event(), stamps({}), zip_, go_on));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(unpacked()), {}), 3);
}

TEST_F(EventZip, LeavesNothingBesideIt) {
  const auto before = folder.files();
  ASSERT_TRUE(write_event_zip(event(), stamps({}), zip_, go_on));
  EXPECT_EQ(folder.files(), before + 1);
  std::filesystem::remove(zip_);
  const auto cancelled = write_event_zip(event(), stamps({}), zip_, cancel);
  ASSERT_FALSE(cancelled);
  EXPECT_THAT(cancelled.error().message, HasSubstr("cancelled"));
  EXPECT_EQ(folder.files(), before);
  std::filesystem::remove(event() / "summary.json");
  const auto without = write_event_zip(event(), stamps({}), zip_, go_on);
  ASSERT_FALSE(without);
  EXPECT_THAT(without.error().message, HasSubstr("summary.json"));
}

TEST(Zip, RefusesMoreThanItCanHave) {
  const tests::TemporaryFolder folder;
  std::ofstream(folder / "large") << "x";
  std::filesystem::resize_file(folder / "large", std::uint64_t{1} << 32);
  auto zip = ZipWriter::create(folder / "a.zip", std::chrono::sys_seconds(std::chrono::years(56)));
  ASSERT_TRUE(zip);
  const auto added = zip->add("large", folder / "large", [](auto, auto, auto) { return true; });
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().message, HasSubstr("at most 4 GiB; choose a smaller range"));
}

}  // namespace
}  // namespace orbwatch::app::recorder
