// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "app/model/alignment/watch_settings.h"
#include "app/model/status/status.h"
#include "app/watch/kept_zero.h"
#include "app/watch/outline_check.h"
#include "hal/clock.h"
#include "proc/align/drift/drift_monitor.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Watches whether one camera still sees the ball where it was aligned. The zero, learnt after an
/// alignment, is kept as a file: a motion while the appliance is off is detected, too. In the
/// picture of the zero the ball is to be looked for: an alignment that was wrong does not move.
/// Thread-bound.
class AlignmentWatch {
 public:
  /// `name`: the camera's. `folder`: of what must outlast a restart. `alignment`: see
  /// alignment_checksum(). Error: an alignment that cannot be watched.
  static Result<AlignmentWatch> make(const std::string& name, const align::DriftSubject& subject,
                                     const WatchSettings& settings,
                                     const std::filesystem::path& folder, std::uint32_t alignment);

  /// Sets the figures of the alignment. Logs when the level changes.
  void observe(const Picture& picture, hal::TimePoint stamp, CameraWatchStatus& figures);

  /// The picture of a zero that observe() learnt or read, in which the stated outline is to be
  /// checked; each only once.
  std::optional<OutlineSubject> take_zero_picture() {
    return std::exchange(zero_picture_, std::nullopt);
  }

  /// The drift by the newest picture.
  const align::DriftState& drift() const { return drift_; }

 private:
  AlignmentWatch(std::string name, align::DriftMonitor monitor, std::filesystem::path file,
                 const ZeroSubject& subject, const optics::Outline& stated);

  void begin(const Picture& picture);
  void learn(const Picture& picture);
  void keep(const KeptZero& zero);
  void offer(const KeptZero& zero);
  void log_level(WatchLevel level);

  std::string name_;
  align::DriftMonitor monitor_;
  std::filesystem::path file_;  ///< of the zero
  ZeroSubject subject_;
  optics::Outline stated_;
  std::optional<OutlineSubject> zero_picture_;  ///< until it is taken
  bool has_begun_ = false;                      ///< the first picture was there
  bool knows_zero_ = false;
  std::optional<KeptZero> first_;  ///< the first picture measured, while the zero is learnt
  align::DriftState drift_;
  WatchLevel level_ = WatchLevel::NotMeasured;  ///< logged last
};

}  // namespace orbwatch::app
