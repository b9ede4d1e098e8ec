#pragma once

#include <array>
#include <chrono>

#include "app/pipeline/status.h"
#include "app/pipeline/status_names.h"

namespace orbwatch::app {

/// The moments of a Status for those who do not have this process' clock.
struct StatusTimes {
  std::chrono::system_clock::time_point stamp{};  ///< of Status::stamp; the epoch: no frame set yet
  std::array<double, kMaxCameras> last_frame_age_s{};  ///< by camera; NaN: no frame yet
  /// Of the state, by alarm; NaN: it has never had another.
  std::array<double, signals::kMaxAlarms> alarm_age_s{};
};

/// How long ago `moment` was, s; NaN for the epoch, which stands for "never".
inline double age_s(hal::TimePoint moment, hal::TimePoint now) {
  if (moment == hal::TimePoint{}) return signals::kNotValid;
  return std::chrono::duration<double>(now - moment).count();
}

/// The times of `status` at `now`; `stamp` is UTC of its stamp.
inline StatusTimes times_of(const Status& status, std::chrono::system_clock::time_point stamp,
                            hal::TimePoint now) {
  StatusTimes times;
  times.stamp = stamp;
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    times.last_frame_age_s[i] = age_s(status.cameras[i].last_frame, now);
  }
  for (std::size_t i = 0; i < signals::kMaxAlarms; ++i) {
    times.alarm_age_s[i] = age_s(status.alarms[i].since, now);
  }
  return times;
}

/// A status that explains itself: what files, pages and other programs are given.
struct StatusReport {
  Status status;  ///< its moments count in the process that made it only
  StatusNames names;
  StatusTimes times;
};

}  // namespace orbwatch::app
