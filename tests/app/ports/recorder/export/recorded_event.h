// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/export/export_range.h"
#include "app/ports/recorder/export/export_steps.h"
#include "tests/app/ports/recorder/events/read_event.h"
#include "tests/app/ports/recorder/events/recorded_machine.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::tests {

/// A test of exports, with an event that the recorder has made of both cameras.
class RecordedEventTest : public testing::Test {
 protected:
  static constexpr std::uint64_t kTrigger = 20;

  void SetUp() override {
    app::recorder::EventSettings events;
    events.ring_mib = 1;
    events.before = std::chrono::milliseconds(100);
    events.after = std::chrono::milliseconds(80);
    RecordedMachine machine({.folder = folder / "recordings", .events = events});
    for (std::uint64_t n = 1; n <= 40; ++n) {
      machine.status.trigger = 1000 + n;
      machine.pass(n, n == kTrigger);
    }
    machine.record_all();
    ASSERT_EQ(machine.events().size(), 1U);
    recording = machine.events().front().folder / app::recorder::kEventFile;
    sets = frame_sets_of(read_recording(recording)["/orbwatch/process_state"]);
    ASSERT_GT(sets.size(), 10U);
  }

  static app::recorder::ExportRange numbers(std::uint64_t from, std::uint64_t to) {
    return {app::recorder::RangeEnd{false, from}, app::recorder::RangeEnd{false, to}};
  }
  app::recorder::StampRange stamps(const app::recorder::ExportRange& range) const {
    const auto found = app::recorder::stamps_in(recording, range);
    EXPECT_TRUE(found) << found.error().message;
    return found.value_or(app::recorder::StampRange());
  }

  /// Changes a byte of the messages.
  void damage() const {
    const auto reader = hal::mcap::Reader::open(recording);
    ASSERT_TRUE(reader);
    const hal::mcap::ChunkIndex& chunk = reader->summary().chunks.back();
    const auto place = static_cast<std::streamoff>(chunk.offset + chunk.length - 4);
    std::fstream file(recording, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(place);
    const int byte = file.get();
    file.seekp(place);
    file.put(static_cast<char>(byte ^ 0x5A));
  }

  static bool go_on(std::size_t /*done*/, std::size_t /*of*/, const char* /*unit*/) { return true; }
  static bool cancel(std::size_t /*done*/, std::size_t /*of*/, const char* /*unit*/) {
    return false;
  }

  TemporaryFolder folder;
  std::filesystem::path recording;
  std::vector<std::uint64_t> sets;  ///< frame sets of the event
};

}  // namespace orbwatch::tests
