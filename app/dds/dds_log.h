#pragma once

#include <cstdint>
#include <optional>

#include "hal/clock.h"

namespace orbwatch::app {

/// Lets a number of lines per minute through and counts the rest. Thread-bound.
class LineBudget {
 public:
  explicit LineBudget(int lines_per_minute) : limit_(lines_per_minute) {}

  /// Whether a line may be written at `now`: then the number of lines withheld since the last one
  /// that was, else nothing.
  std::optional<std::uint64_t> admit(hal::TimePoint now);

 private:
  int limit_;
  int used_ = 0;
  std::uint64_t withheld_ = 0;
  std::optional<hal::TimePoint> minute_;  ///< start of the current one
};

/// Sends the log of Cyclone DDS to stderr, a few lines a minute at most: the loss of a link writes
/// more than a thousand. For the whole process; thread-safe, repeating it does nothing.
void limit_dds_log();

}  // namespace orbwatch::app
