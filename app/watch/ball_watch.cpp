// SPDX-License-Identifier: Apache-2.0
#include "app/watch/ball_watch.h"

#include <system_error>
#include <utility>

#include "app/log.h"
#include "app/watch/kept_file.h"
#include "hal/replay/picture_decoder.h"
#include "proc/align/condition/focus.h"
#include "proc/align/first_plane.h"

namespace orbwatch::app {
namespace {

constexpr double kPercentOfBall = 100;

/// Limits of 0 are none.
WatchLevel level_of(double value, const WatchLimits& limits) {
  if (limits.alarm > 0 && value > limits.alarm) return WatchLevel::Alarm;
  return limits.warning > 0 && value > limits.warning ? WatchLevel::Warning : WatchLevel::Good;
}

/// The maps of a reference are one below the other in its file.
Result<> save(const std::filesystem::path& file, const align::DirtReference& reference) {
  cv::Mat all;
  for (const auto map : align::DirtReference::maps()) all.push_back(reference.*map);
  return keep_file(file, all);
}

Result<align::DirtReference> load(const std::filesystem::path& file) {
  const auto picture = hal::read_picture(file);
  if (!picture) return tl::unexpected(picture.error());
  const cv::Mat all = align::first_plane(picture->picture);
  align::DirtReference reference;
  const int rows = all.rows / static_cast<int>(align::DirtReference::maps().size());
  int first = 0;
  for (const auto map : align::DirtReference::maps()) {
    reference.*map = all.rowRange(first, first + rows).clone();
    first += rows;
  }
  return reference;
}

}  // namespace

Result<BallWatch> BallWatch::make(const std::string& name, int width, int height,
                                  const optics::Outline& outline, const WatchSettings& settings,
                                  const std::filesystem::path& folder) {
  auto dirt = align::DirtWatch::make(width, height, outline);
  if (!dirt) return tl::unexpected(dirt.error());
  BallWatch watch(name, outline, settings, std::move(*dirt),
                  kept_file(folder, "clean", name, outline));
  watch.refer();
  return watch;
}

BallWatch::BallWatch(std::string name, const optics::Outline& outline,
                     const WatchSettings& settings, align::DirtWatch dirt,
                     std::filesystem::path reference)
    : name_(std::move(name)),
      outline_(outline),
      settings_(settings),
      dirt_(std::move(dirt)),
      reference_(std::move(reference)) {}

void BallWatch::refer() {
  std::error_code error;
  if (!std::filesystem::exists(reference_, error)) return;
  const auto used = load(reference_).and_then([&](const align::DirtReference& reference) {
    return dirt_.use(reference);
  });
  is_referred_ = used.has_value();
  if (used) return;
  log_camera(LogLevel::Warning, name_,
             "what the clean ball shows is learnt anew: " + reference_.string() + ": " +
                 used.error().message);
}

void BallWatch::observe(const Picture& picture, hal::TimePoint stamp, CameraWatchStatus& figures) {
  if (!focused_at_ || stamp - *focused_at_ >= kFocusPeriod) {
    focused_at_ = stamp;
    look_at_focus(picture);
  }
  look_at_dirt(picture, stamp);
  figures.focus = seen_.focus;
  figures.blur = seen_.blur;
  figures.cleanliness = seen_.cleanliness;
  figures.contamination = seen_.contamination;
}

void BallWatch::look_at_focus(const Picture& picture) {
  const auto blur = align::reflection_blur(picture, outline_);
  seen_.blur = blur ? blur->sigma : signals::kNotValid;
  seen_.focus = blur ? level_of(seen_.blur, settings_.blur) : WatchLevel::NotMeasured;
  log_level("focus", seen_.focus, logged_focus_);
}

void BallWatch::look_at_dirt(const Picture& picture, hal::TimePoint stamp) {
  dirt_.observe(picture, std::chrono::duration<double>(stamp.time_since_epoch()).count());
  if (!is_referred_) learn();
  const auto& dirt = dirt_.dirt();
  const bool is_measured = is_referred_ && dirt.has_value();
  seen_.contamination = is_measured ? kPercentOfBall * dirt->contamination : signals::kNotValid;
  seen_.cleanliness = is_measured ? level_of(seen_.contamination, settings_.contamination)
                                  : WatchLevel::NotMeasured;
  log_level("ball's dirt", seen_.cleanliness, logged_dirt_);
}

void BallWatch::learn_anew() {
  dirt_.forget();
  is_referred_ = false;
  std::error_code error;
  std::filesystem::remove(reference_, error);
  log_camera(LogLevel::Info, name_, "learns what the clean ball shows");
}

/// The ball is taken to be clean when its camera is aligned.
void BallWatch::learn() {
  const auto learnt = dirt_.learnt();
  if (!learnt || !dirt_.use(*learnt)) return;
  is_referred_ = true;
  if (const auto saved = save(reference_, *learnt); !saved) {
    log_camera(LogLevel::Warning, name_,
               "what the clean ball shows is not kept, it is learnt anew after a restart: " +
                   saved.error().message);
  }
}

void BallWatch::log_level(const char* what, WatchLevel level, WatchLevel& logged) {
  if (level == logged || level == WatchLevel::NotMeasured) return;
  const bool is_first = logged == WatchLevel::NotMeasured;
  logged = level;
  if (is_first && level == WatchLevel::Good) return;
  log_camera(level == WatchLevel::Good ? LogLevel::Info : LogLevel::Warning, name_,
             std::string("its ") + what + " is " + std::string(operator_text(level)));
}

}  // namespace orbwatch::app
