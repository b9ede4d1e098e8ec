// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <fstream>
#include <string>

#include "app/ports/recorder/events/event_folder.h"
#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/log_file.h"
#include "app/ports/recorder/recording_folder.h"
#include "hal/mcap/reader.h"
#include "tests/app/ports/recorder/events/read_event.h"
#include "tests/app/ports/recorder/events/recorded_machine.h"
#include "tests/support/require.h"
#include "tests/support/service_user.h"
#include "tests/support/small_disk.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::recorder {
namespace {

using tests::RecordedMachine;

/// Writes a file until the disk is full.
void fill(const std::filesystem::path& file) {
  std::ofstream filler(file, std::ios::binary);
  const std::string page(4096, 'x');
  while (filler << page << std::flush) continue;
}

TEST(FullDisk, AnEventThatItCutIsFinishedOnceThereIsRoom) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  const orbwatch::tests::TemporaryFolder folder;
  tests::expect_in_a_process([&] {
    tests::mount_small_disk(folder.path(), "size=4m");
    EventSettings events;
    events.ring_mib = 1;
    events.before = events.after = std::chrono::milliseconds(200);
    events.longest = std::chrono::seconds(1);
    RecordedMachine machine({.folder = folder.path(), .events = events});
    for (std::uint64_t n = 1; n <= 30; ++n) machine.pass(n, n == 20);
    for (int round = 0; round < 10; ++round) ASSERT_TRUE(machine.record());
    ASSERT_TRUE(machine.recorder().flush());

    fill(folder / "filler");
    Result<bool> is_more = true;
    while (is_more && *is_more) is_more = machine.record();
    EXPECT_FALSE(is_more.and_then([&](bool) { return machine.recorder().flush(); }));
    machine.recorder().give_up();
    EXPECT_EQ(machine.statistics().recordings_lost, 1U);
    EventFolder stored(folder.path());
    EXPECT_FALSE(stored.prepare()) << "it has no room for the end of the file";
    ASSERT_EQ(machine.events().size(), 1U);
    EXPECT_FALSE(machine.events().front().is_finished);

    std::filesystem::remove(folder / "filler");
    ASSERT_TRUE(stored.prepare());
    const auto finished = machine.events();
    ASSERT_EQ(finished.size(), 1U);
    EXPECT_TRUE(finished.front().is_finished);
    const auto summary = read_summary(finished.front().folder);
    ASSERT_TRUE(summary);
    EXPECT_TRUE(summary->is_interrupted);
    EXPECT_EQ(summary->pictures[0].second + summary->pictures[1].second, 10U)
        << "those that were on the disk";
    auto topics = tests::read_recording(finished.front().folder / kEventFile);
    EXPECT_EQ(topics["/orbwatch/thermal/image_raw"].size(), summary->pictures[0].second);

    for (std::uint64_t n = 31; n <= 100; ++n) machine.pass(n, n == 60);
    machine.record_all();
    EXPECT_EQ(machine.statistics().recordings, 1U);
    EXPECT_EQ(machine.events().size(), 2U);
  });
}

TEST(ReadOnlyDisk, WhatItCutIsFinishedOnceItCanBeWritten) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  const orbwatch::tests::TemporaryFolder folder;
  tests::expect_in_a_process([&] {
    tests::mount_small_disk(folder.path(), "size=8m");
    const auto remount = [&](unsigned long flags) {
      tests::require(::mount("", folder.path().c_str(), nullptr, MS_REMOUNT | flags, "") == 0);
    };
    EventSettings events;
    events.ring_mib = 1;
    const RecorderSettings settings{.folder = folder.path(), .events = events};
    const std::filesystem::path log = folder / "log-20261128T090000Z.mcap";
    {
      auto file = LogFile::create(log, {}, Utc() + std::chrono::hours(1));
      tests::require(file.has_value());
      EXPECT_TRUE(file->flush());
    }
    RecordedMachine machine(settings);
    for (std::uint64_t n = 1; n <= 30; ++n) machine.pass(n, n == 20);
    for (int round = 0; round < 10; ++round) ASSERT_TRUE(machine.record());
    ASSERT_TRUE(machine.recorder().flush());
    machine.recorder().give_up();
    remount(MS_RDONLY);
    RecordingFolder stored(settings);
    ASSERT_TRUE(stored.prepare());
    ASSERT_EQ(machine.events().size(), 1U);
    EXPECT_FALSE(machine.events().front().is_finished);

    remount(0);
    ASSERT_TRUE(stored.prepare());
    ASSERT_EQ(machine.events().size(), 1U);
    EXPECT_TRUE(machine.events().front().is_finished);
    const auto finished = hal::mcap::Reader::open(log);
    ASSERT_TRUE(finished) << finished.error().message;
    EXPECT_TRUE(finished->is_finished());
  });
}

}  // namespace
}  // namespace orbwatch::app::recorder
