// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "app/model/sink/recorded_texts.h"
#include "app/model/sink/sink.h"
#include "app/model/status/status_report.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

/// The [recorder] part of the site file.
struct RecorderSettings {
  static constexpr std::string_view kName = "recorder",
                                    kText =
                                        "Log of measurements and of the machine's state on disk";

  std::filesystem::path folder;  ///< empty: nothing is recorded
  int limit_mib = 4096;          ///< of all recordings together
  int reserve_mib = 512;         ///< free space that recordings leave on the disk
};

template <class Visitor>
void visit(Visitor& v, RecorderSettings& recorder) {
  v.required("folder", recorder.folder,
             "Folder for the recordings, MCAP files with the signals, alarms and machine state of "
             "every frame set; ROS 2, Foxglove and Python read them");
  v.optional("limit_mib", recorder.limit_mib, Range::between(256, 1e9),
             "Limit of all recordings together, MiB; a further one deletes the oldest");
  v.optional("reserve_mib", recorder.reserve_mib, Range::between(16, 1e9),
             "Free space on the disk below which the oldest recordings are deleted, MiB; if there "
             "is none left, recording waits");
}

/// Null without a folder.
std::unique_ptr<Sink> make_sink(const RecorderSettings& settings, const StatusNames& names,
                                const RecordedTexts& texts);

}  // namespace orbwatch::app
