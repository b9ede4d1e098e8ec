// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "app/ports/recorder/events/event_archive.h"
#include "app/ports/recorder/events/event_name.h"
#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/recording_folder.h"
#include "hal/thread/file_descriptor.h"
#include "tests/support/require.h"
#include "tests/support/temporary_folder.h"

/// The cost of many events, counted as folders that are opened and summaries that are read.
namespace orbwatch::app::recorder {
namespace {

namespace fs = std::filesystem;
using orbwatch::tests::require;

/// Counts how often a folder and the folders in it are opened, by the kernel's records.
class FolderOpens {
 public:
  explicit FolderOpens(const fs::path& folder)
      : inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    require(::inotify_add_watch(inotify_.get(), folder.c_str(), IN_OPEN | IN_ONLYDIR) >= 0);
  }

  /// Since the last call.
  int count() {
    int opens = 0;
    alignas(inotify_event) std::array<char, 1 << 16> records;
    for (;;) {
      const ssize_t size = ::read(inotify_.get(), records.data(), records.size());
      if (size <= 0) return opens;
      for (ssize_t at = 0; at < size;) {
        inotify_event record;
        std::memcpy(&record, records.data() + at, sizeof record);
        require((record.mask & IN_Q_OVERFLOW) == 0);
        opens += (record.mask & IN_ISDIR) != 0 ? 1 : 0;
        at += static_cast<ssize_t>(sizeof record + record.len);
      }
    }
  }

 private:
  hal::FileDescriptor inotify_;
};

class ManyEvents : public testing::Test {
 protected:
  static constexpr int kCount = 10'000;

  /// Events whose summaries are one file, so that they are made, and changed, quickly.
  void SetUp() override {
    fs::create_directory(events());
    write_summary(shared_summary(), "as recorded");
    for (int n = 0; n < kCount; ++n) {
      fs::create_directory(events() / name_of(n));
      fs::create_hard_link(shared_summary(), events() / name_of(n) / kEventSummary);
      set_age(events() / name_of(n));
    }
    set_age(events());
    set_age(folder_.path());
  }

  static std::string name_of(int n) {
    return event_name(
        Utc(std::chrono::sys_days(std::chrono::year(2026) / 11 / 28)) + std::chrono::seconds(n),
        TriggerKind::Layer);
  }
  fs::path events() const { return folder_ / "events"; }

  fs::path shared_summary() const { return folder_ / "summary.json"; }

  static void write_summary(const fs::path& file, const std::string& text) {
    EventSummary summary;
    summary.trigger = "layer";
    summary.text = text;
    std::ofstream(file) << summary_text(summary);
  }
  void add(int n, const std::string& text) const {
    fs::create_directory(events() / name_of(n));
    write_summary(events() / name_of(n) / kEventSummary, text);
  }
  /// A folder as an hour after its last change.
  static void set_age(const fs::path& folder) {
    fs::last_write_time(folder, fs::file_time_type::clock::now() - std::chrono::hours(1));
  }

  const orbwatch::tests::TemporaryFolder folder_;
};

TEST_F(ManyEvents, CostTheRecorderNothingUntilOneIsAdded) {
  RecordingFolder folder({.folder = folder_.path()});
  FolderOpens events_opened(events()), opened(folder_.path());
  ASSERT_EQ(folder.make_room({}, {}), 0);
  ASSERT_GE(events_opened.count(), kCount) << "each is read once";
  opened.count();
  for (int second = 0; second < 100; ++second) ASSERT_EQ(folder.make_room({}, {}), 0);
  EXPECT_EQ(events_opened.count() + opened.count(), 0);

  add(kCount, "by another program");
  ASSERT_EQ(folder.make_room({}, {}), 0);
  const int opens = events_opened.count();
  EXPECT_GE(opens, 2) << "the folder and the event that is new";
  EXPECT_LE(opens, 4);
}

TEST_F(ManyEvents, AreListedWithTheSummariesThatWereReadOnce) {
  EventArchive archive(folder_.path());
  const auto first = archive.list();
  ASSERT_TRUE(first) << first.error().message;
  ASSERT_EQ((*first)->size(), std::size_t{kCount});
  EXPECT_EQ(archive.list().value(), *first) << "the same object";

  // Unnoticed, because names stay: whoever reads it finds another text.
  write_summary(shared_summary(), "read again");
  add(kCount, "new");
  fs::remove_all(events() / name_of(0));
  const auto second = archive.list();
  ASSERT_TRUE(second) << second.error().message;
  ASSERT_EQ((*second)->size(), std::size_t{kCount});
  EXPECT_EQ((*second)->front().name, name_of(1));
  EXPECT_EQ((*second)->back().text, "new");
  EXPECT_EQ(std::ranges::count((**second), "as recorded", &RecordedEvent::text), kCount - 1);

  ASSERT_TRUE(archive.set_pinned(name_of(7), true));
  const auto third = archive.list();
  ASSERT_TRUE(third) << third.error().message;
  EXPECT_TRUE((**third)[6].is_pinned);
  EXPECT_EQ(std::ranges::count((**third), "read again", &RecordedEvent::text), 1);
}

}  // namespace
}  // namespace orbwatch::app::recorder
