// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <chrono>
#include <string>

#include "hal/clock.h"
#include "hal/mcap/reader.h"
#include "proc/image/result.h"

namespace orbwatch::hal::recording {

/// The difference by which a recording converts its appliance's steady clock to UTC: times that
/// were measured with return bit by bit.
class RecordedClock {
 public:
  /// `utc`: nanoseconds since 1970 at the moment 0 of the steady clock.
  explicit RecordedClock(std::int64_t utc = 0) : utc_(utc) {}

  /// The clock by which `moment` is `utc`, nanoseconds since 1970.
  static RecordedClock when(TimePoint moment, std::uint64_t utc) {
    return RecordedClock(static_cast<std::int64_t>(utc) - in_nanoseconds(moment));
  }

  std::uint64_t to_utc(TimePoint moment) const {
    return static_cast<std::uint64_t>(in_nanoseconds(moment) + utc_);
  }
  TimePoint to_moment(std::uint64_t utc) const {
    return TimePoint(std::chrono::nanoseconds(static_cast<std::int64_t>(utc) - utc_));
  }

  mcap::Metadata metadata() const { return {std::string(kName), {{kKey, std::to_string(utc_)}}}; }

  /// Clock of the recording; UTC itself if it states none. Error: a wrong number; damaged.
  static Result<RecordedClock> of(mcap::Reader& reader) {
    const auto& all = reader.summary().metadata;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].name != kName) continue;
      const auto metadata = reader.metadata(k);
      if (!metadata) return fail(metadata.error().message);
      return parse(*metadata);
    }
    return RecordedClock();
  }

 private:
  static constexpr const char* kName = "clock";
  static constexpr const char* kKey = "utc_at_zero_ns";

  static std::int64_t in_nanoseconds(TimePoint moment) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(moment.time_since_epoch()).count();
  }

  static Result<RecordedClock> parse(const mcap::Metadata& metadata) {
    for (const auto& [key, text] : metadata.entries) {
      std::int64_t utc = 0;
      const char* const end = text.data() + text.size();
      const auto [stop, error] = std::from_chars(text.data(), end, utc);
      const bool is_right = error == std::errc() && stop == end && utc >= 0;
      if (key == kKey && is_right) return RecordedClock(utc);
    }
    return fail("metadata clock: it must have " + std::string(kKey) +
                ", nanoseconds of UTC since 1970");
  }

  std::int64_t utc_;
};

}  // namespace orbwatch::hal::recording
