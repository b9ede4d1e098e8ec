// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "app/model/sink/recorded_camera.h"
#include "app/model/sink/recorded_events.h"
#include "app/model/sink/recorded_exports.h"
#include "app/model/sink/recorded_texts.h"
#include "app/model/sink/sink.h"
#include "app/model/status/status_report.h"
#include "app/ports/recorder/events/event_settings.h"
#include "proc/image/result.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

/// The [recorder] part of the site file.
struct RecorderSettings {
  static constexpr std::string_view
      kName = "recorder",
      kText =
          "Log of measurements and of the machine's state on disk, and events "
          "with pictures";

  std::filesystem::path folder;  ///< empty: nothing is recorded
  int limit_mib = 4096;          ///< of all recordings together
  int reserve_mib = 512;         ///< free space that recordings leave on the disk
  std::optional<recorder::EventSettings> events{};  ///< nullopt: no pictures are recorded
};

template <class Visitor>
void visit(Visitor& v, RecorderSettings& recorder) {
  v.required("folder", recorder.folder,
             "Folder for the recordings, MCAP files with the signals, alarms and machine state of "
             "every frame set; ROS 2, Foxglove and Python read them; a folder outside the state "
             "folder needs ReadWritePaths= in the unit");
  v.optional("limit_mib", recorder.limit_mib, Range::between(256, 1e9),
             "Limit of all recordings together, MiB; a further one deletes the oldest. Events that "
             "are kept leave at least a quarter of it to the others");
  v.optional("reserve_mib", recorder.reserve_mib, Range::between(16, 1e9),
             "Free space on the disk below which the oldest recordings are deleted, MiB; if there "
             "is none left, recording waits");
  v.table("events", recorder.events,
          "Events with the cameras' pictures from before and after a trigger, in the folder "
          "`events` of the recordings; only the ball's part of a picture is kept");
}

/// Checks that the ring holds an event. Error: as recorder::check_ring(). Reentrant.
Result<> check_recorded(const RecorderSettings& settings,
                        const std::vector<RecordedCamera>& cameras);

/// True: events have pictures of the camera. Reentrant.
bool records_pictures(const RecorderSettings& settings, std::string_view camera);

/// Events that are recorded by these settings, for other interfaces; null: none are.
std::shared_ptr<RecordedEvents> recorded_events(const RecorderSettings& settings);

/// Exports of these events, for other interfaces; null: none are recorded.
std::shared_ptr<RecordedExports> recorded_exports(const RecorderSettings& settings);

/// Null without a folder. `cameras` by index.
std::unique_ptr<Sink> make_sink(const RecorderSettings& settings, const StatusNames& names,
                                const RecordedTexts& texts,
                                const std::vector<RecordedCamera>& cameras);

}  // namespace orbwatch::app
