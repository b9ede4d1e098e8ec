// SPDX-License-Identifier: Apache-2.0
#include "app/watch/alignment_watch.h"

#include <cmath>
#include <cstdio>
#include <system_error>
#include <utility>

#include "app/log.h"
#include "app/watch/kept_file.h"
#include "hal/replay/picture_decoder.h"
#include "proc/align/detect/picture/luminance.h"

namespace orbwatch::app {
namespace {

constexpr double kPercentOfRadius = 100;

WatchLevel level_of(align::DriftLevel level) {
  switch (level) {
    case align::DriftLevel::NotMeasured:
      return WatchLevel::NotMeasured;
    case align::DriftLevel::Good:
      return WatchLevel::Good;
    case align::DriftLevel::Warning:
      return WatchLevel::Warning;
    case align::DriftLevel::Alarm:
      return WatchLevel::Alarm;
  }
  return WatchLevel::NotMeasured;
}

AlignmentLevel level_of(const align::DriftState& drift) {
  if (drift.is_learning) return AlignmentLevel::Learning;
  if (drift.level == align::DriftLevel::NotMeasured) return AlignmentLevel::NotVisible;
  return alignment_level(level_of(drift.level));
}

}  // namespace

Result<AlignmentWatch> AlignmentWatch::make(const std::string& name,
                                            const align::DriftSubject& subject,
                                            const WatchSettings& settings,
                                            const std::filesystem::path& folder) {
  auto monitor = align::DriftMonitor::make(subject, settings.drift);
  if (!monitor) return tl::unexpected(monitor.error());
  AlignmentWatch watch(name, std::move(*monitor),
                       kept_file(folder, "aligned", name, subject.outline));
  watch.refer();
  return watch;
}

AlignmentWatch::AlignmentWatch(std::string name, align::DriftMonitor monitor,
                               std::filesystem::path reference)
    : name_(std::move(name)), monitor_(std::move(monitor)), reference_(std::move(reference)) {}

void AlignmentWatch::refer() {
  std::error_code error;
  if (!std::filesystem::exists(reference_, error)) return;
  const auto picture = hal::read_picture(reference_);
  const auto referred =
      picture ? monitor_.refer_to(picture->picture) : Result<>(tl::unexpected(picture.error()));
  is_referred_ = referred.has_value();
  if (!referred) {
    log_camera(LogLevel::Warning, name_,
               "the picture of its alignment cannot be used, the first one from now on counts: " +
                   referred.error().message);
  }
}

void AlignmentWatch::observe(const Picture& picture, hal::TimePoint stamp,
                             CameraWatchStatus& figures) {
  const auto drift = monitor_.observe(picture, stamp.time_since_epoch());
  if (!drift) return;  // another size: the camera has a fault
  drift_ = *drift;
  figures.alignment = level_of(drift_);
  const bool is_measured = drift_.level != align::DriftLevel::NotMeasured && !drift_.is_learning;
  const double radius = optics::mean_radius(drift_.outline);
  figures.drift_error = is_measured ? drift_.direction_error : signals::kNotValid;
  figures.drift_shift =
      is_measured ? kPercentOfRadius * std::hypot(drift_.motion.u, drift_.motion.v) / radius
                  : signals::kNotValid;
  if (!is_referred_ && drift_.level == align::DriftLevel::Good) keep(picture);
  log_level(is_measured ? level_of(drift_.level) : WatchLevel::NotMeasured);
}

void AlignmentWatch::keep(const Picture& picture) {
  is_referred_ = true;
  if (const auto written = keep_file(reference_, align::luminance_of(picture)); !written) {
    log_camera(LogLevel::Warning, name_,
               "the picture of its alignment is not kept, after a restart the alignment counts "
               "from then on: " +
                   written.error().message);
  }
}

void AlignmentWatch::log_level(WatchLevel level) {
  // Darkness comes and goes.
  if (level == level_ || level == WatchLevel::NotMeasured) return;
  const bool is_first = level_ == WatchLevel::NotMeasured;
  level_ = level;
  if (is_first && level == WatchLevel::Good) return;
  char error[32];
  std::snprintf(error, sizeof error, "%.2f", drift_.direction_error);
  std::string text = "its alignment is " + std::string(operator_text(level)) +
                     ": views are off by " + error + " deg rms";
  if (drift_.cause != align::DriftCause::Unknown) {
    text += ", " + std::string(align::text(drift_.cause));
  }
  log_camera(level == WatchLevel::Good ? LogLevel::Info : LogLevel::Warning, name_, text);
}

}  // namespace orbwatch::app
