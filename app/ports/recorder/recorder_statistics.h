// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <type_traits>

#include "app/model/status/field.h"

namespace orbwatch::app::recorder {

inline constexpr Quantity kBytesPerDay{"MiB", 0.1, 0, 1e9};
inline constexpr Quantity kRingBytes{"MiB", 0.1, 0, 65536};
inline constexpr Quantity kRingSpan{"s", 0.01, 0, 1e6};

#define ORBWATCH_RECORDER_COUNTERS(FIELD)                                                      \
  FIELD(std::uint64_t, recorded, kCount, "Frame sets recorded since start")                    \
  FIELD(std::uint64_t, events, kCount, "Events of alarms recorded since start")                \
  FIELD(std::uint64_t, lost, kCount,                                                           \
        "Frame sets and events that were not recorded: the disk failed or did not keep up")    \
  FIELD(std::uint64_t, bytes, kCount, "Bytes written since start")                             \
  FIELD(std::uint64_t, removed, kCount,                                                        \
        "Recordings deleted to stay within the limits of size and age")                        \
  FIELD(std::uint64_t, pictures, kCount, "Pictures recorded in events since start")            \
  FIELD(std::uint64_t, recordings, kCount, "Events recorded with pictures since start")        \
  FIELD(std::uint64_t, recordings_lost, kCount,                                                \
        "Triggers without an event, or events not recorded to their end: the disk failed, or " \
        "too many events at once")

#define ORBWATCH_RECORDER_FIGURES(FIELD)                                                   \
  FIELD(bool, fault, kFlag,                                                                \
        "The disk cannot be written, or is silent, or pinned events take more than three " \
        "quarters of limit_mib: see the log")                                              \
  FIELD(double, per_day, kBytesPerDay, "Data written per day, at the rate since start")    \
  FIELD(std::uint64_t, triggers_joined, kCount,                                            \
        "Triggers that extended an event instead of beginning one")                        \
  FIELD(std::uint64_t, pictures_lost, kCount,                                              \
        "Pictures that found no room in the ring: the disk or coding did not keep up")     \
  FIELD(double, ring_used, kRingBytes, "Memory of the ring that pictures take")            \
  FIELD(double, ring_span, kRingSpan, "Time from the oldest picture in the ring to the newest")

/// Figures of the recorder since start.
struct RecorderStatistics {
  ORBWATCH_RECORDER_COUNTERS(ORBWATCH_FIELD_MEMBER)
  ORBWATCH_RECORDER_FIGURES(ORBWATCH_FIELD_MEMBER)
};

template <class Visit>
constexpr void for_each_field(std::type_identity<RecorderStatistics>, Visit&& visit) {
  using Part = RecorderStatistics;
  ORBWATCH_RECORDER_COUNTERS(ORBWATCH_VISIT_FIELD)
  ORBWATCH_RECORDER_FIGURES(ORBWATCH_VISIT_FIELD)
}

/// The counters; written by the recorder's thread, read by any.
struct RecorderCounters {
#define ORBWATCH_COUNTER(type, name, ...) std::atomic<type> name{0};
  ORBWATCH_RECORDER_COUNTERS(ORBWATCH_COUNTER)
#undef ORBWATCH_COUNTER

  RecorderStatistics read() const {
    RecorderStatistics statistics;
#define ORBWATCH_READ(type, name, ...) statistics.name = name;
    ORBWATCH_RECORDER_COUNTERS(ORBWATCH_READ)
#undef ORBWATCH_READ
    return statistics;
  }
};

}  // namespace orbwatch::app::recorder
