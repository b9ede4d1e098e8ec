// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/backup/events/kept_events.h"
#include "app/ports/recorder/events/event_summary.h"
#include "tests/app/cli/backup/site.h"

namespace orbwatch::app::cli::backup {

/// Names of events that are kept.
inline constexpr const char* kFirst = "20261128T092200.125Z-alarm";
inline constexpr const char* kSecond = "20261128T092300.000Z-command-2";

/// An old device with two of them and others, and the place of a new one.
class EventsOfADevice : public testing::Test {
 protected:
  EventsOfADevice() {
    write_file(old / kFirst / recorder::kEventFile, std::string(300'000, 'm'));
    write_file(old / kFirst / recorder::kEventSummary, "{}");
    write_file(old / kFirst / recorder::kEventPicture, "picture");
    write_file(old / kFirst / recorder::kEventPin, "");
    write_file(old / kSecond / recorder::kEventFile, std::string(512, 'n'));
    write_file(old / kSecond / recorder::kEventPin, "");
    write_file(old / "20261128T092400.000Z-alarm" / recorder::kEventFile, "not kept");
    write_file(old / "20261128T092500.000Z-alarm.unfinished" / recorder::kEventPin, "");
    std::filesystem::create_directories(folder / "new");
  }

  std::vector<recorder::StoredEvent> listed() const {
    return recorder::EventFolder(folder / "old")
        .list()
        .value_or(std::vector<recorder::StoredEvent>());
  }
  std::vector<recorder::StoredEvent> kept() const {
    std::vector<std::string> left_out;
    auto events = kept_events(listed(), left_out);
    EXPECT_TRUE(left_out.empty());
    EXPECT_TRUE(events) << events.error().message;
    return events.value_or(std::vector<recorder::StoredEvent>());
  }
  std::string frame() const {
    std::string bytes;
    EXPECT_TRUE(
        write_events(kept(), manifest_events(kept()), [&](std::string_view part) -> Result<> {
          bytes += part;
          return {};
        }));
    return bytes;
  }

  tests::TemporaryFolder folder;
  const std::filesystem::path old = folder / "old/events";
};

}  // namespace orbwatch::app::cli::backup
