// SPDX-License-Identifier: Apache-2.0
#include "app/cli/drift/drift_run.h"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <system_error>
#include <vector>

#include "hal/replay/picture_decoder.h"
#include "hal/replay/picture_sequence.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;
using align::DriftLevel;
using align::DriftMonitor;

constexpr std::string_view kLearning = "the zero of the drift is being learnt";

Error about(const std::string& file, const Error& error, const hal::DecodedPicture& picture) {
  return {file + ": " + error.message + exif_note(picture)};
}

Result<> refer_to(DriftMonitor& monitor, const fs::path& file) {
  const auto reference = hal::read_picture(file);
  if (!reference) return tl::unexpected(reference.error());
  return monitor.refer_to(reference->picture).map_error([&](const Error& error) {
    return about(file.string(), error, *reference);
  });
}

/// Counts a picture without a measured drift. The figures are those of the last one that was
/// measured: while the zero is learnt, a slow motion moves it, too.
void note_unmeasured(const align::DriftState& state, DriftRun& run) {
  const bool is_learning = state.level != DriftLevel::NotMeasured;
  run.last.level = DriftLevel::NotMeasured;
  run.last.is_learning = state.is_learning;
  run.last.reason = is_learning ? kLearning : state.reason;
  ++run.not_measured[std::string(run.last.reason)];
}

void note(const align::DriftState& state, const std::string& name, DriftRun& run) {
  const DriftRun::Event event{run.frames++, name};
  if (state.level == DriftLevel::NotMeasured || state.is_learning) {
    return note_unmeasured(state, run);
  }
  run.last = state;
  ++run.measured;
  if (state.level >= DriftLevel::Warning && !run.first_warning) run.first_warning = event;
  if (state.level == DriftLevel::Alarm && !run.first_alarm) run.first_alarm = event;
}

/// Time of a picture since the first one.
DriftMonitor::Time time_of(const hal::PictureSequence& pictures, std::size_t n, double rate) {
  const std::chrono::duration<double> at_rate(static_cast<double>(n) / rate);
  const auto recorded = pictures.time(n);
  return recorded ? std::chrono::duration_cast<DriftMonitor::Time>(*recorded)
                  : std::chrono::duration_cast<DriftMonitor::Time>(at_rate);
}

}  // namespace

Result<DriftRun> watch(const align::DriftSubject& subject, const align::DriftLimits& limits,
                       const DriftSequence& sequence, Progress& progress) {
  auto monitor = DriftMonitor::make(subject, limits);
  if (!monitor) return tl::unexpected(monitor.error());
  auto pictures = hal::PictureSequence::open(sequence.source, sequence.camera);
  if (!pictures) return tl::unexpected(pictures.error());
  if (!sequence.reference.empty()) {
    const auto referred = refer_to(*monitor, sequence.reference);
    if (!referred) return tl::unexpected(referred.error());
  }
  DriftRun run;
  run.last.outline = subject.outline;
  for (std::size_t n = 0; n < pictures->size(); ++n) {
    progress.count("watching", n + 1, pictures->size(), "pictures");
    const auto decoded = pictures->read(n);
    if (!decoded) return tl::unexpected(decoded.error());
    const auto state = monitor->observe(decoded->picture, time_of(*pictures, n, sequence.rate));
    if (!state) return tl::unexpected(about(pictures->path(n), state.error(), *decoded));
    note(*state, pictures->name(n), run);
  }
  return run;
}

}  // namespace orbwatch::app::cli
