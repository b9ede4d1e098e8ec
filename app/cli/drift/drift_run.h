// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/cli/progress.h"
#include "proc/align/drift/drift_monitor.h"

namespace orbwatch::app::cli {

/// Pictures of one camera in the order in which they were taken.
struct DriftSequence {
  std::filesystem::path source;     ///< a folder, a picture or a recording
  std::string camera;               ///< in a recording
  double rate = 30;                 ///< pictures per second; a recording has their times
  std::filesystem::path reference;  ///< on which the alignment was made; empty: the first pictures
};

/// An alignment watched over a sequence.
struct DriftRun {
  std::size_t frames = 0;
  std::size_t measured = 0;
  /// Number of the others, by reason.
  std::map<std::string, std::size_t> not_measured;
  /// Numbers from 0; with the picture's name, see PictureSequence.
  struct Event {
    std::size_t frame = 0;
    std::string file;
  };
  std::optional<Event> first_warning;  ///< or alarm
  std::optional<Event> first_alarm;
  /// State at the last picture; its figures are those of the last one that was measured, or of the
  /// stored alignment.
  align::DriftState last;
};

/// Watches the whole sequence, see hal::PictureSequence. Errors: no pictures, one that cannot be
/// read, another size, those of DriftMonitor.
Result<DriftRun> watch(const align::DriftSubject& subject, const align::DriftLimits& limits,
                       const DriftSequence& sequence, Progress& progress);

}  // namespace orbwatch::app::cli
