// SPDX-License-Identifier: Apache-2.0
#include "app/cli/drift/drift_run.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <vector>

#include "hal/replay/picture_decoder.h"
#include "hal/replay/picture_folder.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;
using align::DriftLevel;
using align::DriftMonitor;

Error about(const fs::path& file, const Error& error, const hal::DecodedPicture& picture) {
  return {file.string() + ": " + error.message + exif_note(picture)};
}

Result<> refer_to(DriftMonitor& monitor, const fs::path& file) {
  const auto reference = hal::read_picture(file);
  if (!reference) return tl::unexpected(reference.error());
  return monitor.refer_to(reference->picture).map_error([&](const Error& error) {
    return about(file, error, *reference);
  });
}

void note(const align::DriftState& state, const fs::path& file, DriftRun& run) {
  const DriftRun::Event event{run.frames++, file.filename().string()};
  run.last = state;
  if (state.level == DriftLevel::NotMeasured) {
    ++run.not_measured[std::string(state.reason)];
    return;
  }
  ++run.measured;
  if (state.level >= DriftLevel::Warning && !run.first_warning) run.first_warning = event;
  if (state.level == DriftLevel::Alarm && !run.first_alarm) run.first_alarm = event;
}

}  // namespace

Result<DriftRun> watch(const align::DriftSubject& subject, const align::DriftLimits& limits,
                       const DriftSequence& sequence, Progress& progress) {
  auto monitor = DriftMonitor::make(subject, limits);
  if (!monitor) return tl::unexpected(monitor.error());
  const auto files = hal::pictures_in(sequence.folder);
  if (!files) return tl::unexpected(files.error());
  if (!sequence.reference.empty()) {
    const auto referred = refer_to(*monitor, sequence.reference);
    if (!referred) return tl::unexpected(referred.error());
  }
  DriftRun run;
  for (const fs::path& file : *files) {
    progress.count("watching", run.frames + 1, files->size(), "pictures");
    const auto decoded = hal::read_picture(file);
    if (!decoded) return tl::unexpected(decoded.error());
    const std::chrono::duration<double> time(static_cast<double>(run.frames) / sequence.rate);
    const auto state =
        monitor->observe(decoded->picture, std::chrono::duration_cast<DriftMonitor::Time>(time));
    if (!state) return tl::unexpected(about(file, state.error(), *decoded));
    note(*state, file, run);
  }
  return run;
}

}  // namespace orbwatch::app::cli
