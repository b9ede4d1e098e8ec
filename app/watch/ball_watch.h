// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "app/model/alignment/watch_settings.h"
#include "app/model/status/status.h"
#include "hal/clock.h"
#include "proc/align/condition/dirt_watch.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Watches whether what one camera sees in the ball is sharp, and whether the ball is clean. What
/// the clean ball shows is learnt once for each alignment and kept as a file. Thread-bound.
class BallWatch {
 public:
  /// A look at the focus takes some milliseconds.
  static constexpr std::chrono::seconds kFocusPeriod{10};

  /// `name`: the camera's. `folder`: of what must outlast a restart. Error: an outline that lies
  /// outside of pictures of that size.
  static Result<BallWatch> make(const std::string& name, int width, int height,
                                const optics::Outline& outline, const WatchSettings& settings,
                                const std::filesystem::path& folder);

  /// Sets the figures of focus and dirt. Logs when a level changes.
  void observe(const Picture& picture, hal::TimePoint stamp, CameraWatchStatus& figures);

  /// The ball was cleaned: what it shows from now on is clean.
  void learn_anew();

 private:
  BallWatch(std::string name, const optics::Outline& outline, const WatchSettings& settings,
            align::DirtWatch dirt, std::filesystem::path reference);

  void refer();
  void learn();
  void look_at_focus(const Picture& picture);
  void look_at_dirt(const Picture& picture, hal::TimePoint stamp);
  void log_level(const char* what, WatchLevel level, WatchLevel& logged);

  std::string name_;
  optics::Outline outline_;
  WatchSettings settings_;
  align::DirtWatch dirt_;
  std::filesystem::path reference_;
  bool is_referred_ = false;
  std::optional<hal::TimePoint> focused_at_;
  CameraWatchStatus seen_;  ///< the figures of this watch
  WatchLevel logged_focus_ = WatchLevel::NotMeasured;
  WatchLevel logged_dirt_ = WatchLevel::NotMeasured;
};

}  // namespace orbwatch::app
