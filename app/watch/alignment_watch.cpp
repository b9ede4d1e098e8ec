// SPDX-License-Identifier: Apache-2.0
#include "app/watch/alignment_watch.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "app/log.h"
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
                                            const std::filesystem::path& folder,
                                            std::uint32_t alignment) {
  auto monitor = align::DriftMonitor::make(subject, settings.drift);
  if (!monitor) return tl::unexpected(monitor.error());
  return AlignmentWatch(name, std::move(*monitor), zero_file(folder, name),
                        {.alignment = alignment, .width = subject.width, .height = subject.height},
                        subject.outline);
}

AlignmentWatch::AlignmentWatch(std::string name, align::DriftMonitor monitor,
                               std::filesystem::path file, const ZeroSubject& subject,
                               const optics::Outline& stated)
    : name_(std::move(name)),
      monitor_(std::move(monitor)),
      file_(std::move(file)),
      subject_(subject),
      stated_(stated) {}

/// Continues with the zero that is kept. Only a picture states the format that it must be of.
void AlignmentWatch::begin(const Picture& picture) {
  if (picture.width != subject_.width || picture.height != subject_.height) return;
  has_begun_ = true;
  subject_.format = luminance_format(picture.format);
  const auto kept = kept_zero(file_, subject_);
  if (kept && !*kept) {
    log_camera(LogLevel::Info, name_,
               "learns the zero of its drift: none is kept of this alignment");
    return;
  }
  const auto referred = kept.and_then([&](const std::optional<KeptZero>& zero) {
    return monitor_.refer_to(luminance_picture(zero->luminance, subject_.format), zero->zero);
  });
  knows_zero_ = referred.has_value();
  if (referred) return offer(**kept);
  log_camera(LogLevel::Warning, name_,
             "learns the zero of its drift anew, and a motion before this start is not noticed: " +
                 referred.error().message);
}

void AlignmentWatch::observe(const Picture& picture, hal::TimePoint stamp,
                             CameraWatchStatus& figures) {
  if (!has_begun_) begin(picture);
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
  if (!knows_zero_) learn(picture);
  log_level(is_measured ? level_of(drift_.level) : WatchLevel::NotMeasured);
}

/// The picture that is kept is the first one measured: a jump, which ends the learning, is not in
/// it.
void AlignmentWatch::learn(const Picture& picture) {
  if (drift_.level == align::DriftLevel::NotMeasured) return;
  if (!first_) first_ = KeptZero{monitor_.zero(), align::luminance_of(picture).clone()};
  if (drift_.is_learning) return;
  const align::DriftZero zero = monitor_.zero();
  const KeptZero learnt{{zero.place - first_->zero.place, zero.sigma}, first_->luminance};
  first_.reset();
  knows_zero_ = true;
  keep(learnt);
  offer(learnt);
}

void AlignmentWatch::keep(const KeptZero& zero) {
  const auto written = keep_zero(file_, subject_, zero);
  if (written) return;
  log_camera(LogLevel::Warning, name_,
             "the zero of its drift is not kept, it is learnt anew after a restart: " +
                 written.error().message);
}

/// The ball is a little beside its zero in the picture that is kept.
void AlignmentWatch::offer(const KeptZero& zero) {
  zero_picture_ = {zero.luminance, subject_.format,
                   align::moved(stated_, align::PictureMotion{} - zero.zero.place)};
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
