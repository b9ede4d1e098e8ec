// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/export_range.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "app/model/status/utc_text.h"
#include "app/ports/recorder/recorded_states.h"
#include "app/ports/recorder/recorded_utc.h"

namespace orbwatch::app::recorder {
namespace {

/// Parses all of a text as a whole number.
std::optional<std::uint64_t> parse_digits(std::string_view text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

bool is_reached(const RangeEnd& end, const RecordedState& state) {
  return (end.is_moment ? state.utc : state.state.frame_set) >= end.value;
}
bool is_passed(const RangeEnd& end, const RecordedState& state) {
  return (end.is_moment ? state.utc : state.state.frame_set) > end.value;
}

std::string name_of(const RecordedState& state) {
  return std::to_string(state.state.frame_set) + " (" + utc_text_at(state.utc) + ")";
}

}  // namespace

Result<RangeEnd> parse_range_end(std::string_view text) {
  if (const auto number = parse_digits(text)) return RangeEnd{false, *number};
  if (const auto moment = parse_utc_text(text)) return RangeEnd{true, *moment};
  return fail("\"" + std::string(text) +
              "\" must be the number of a frame set, or UTC such as 2026-11-28T09:22:00.125Z");
}

Result<StampRange> stamps_in(const std::filesystem::path& recording, const ExportRange& range) {
  auto states = RecordedStates::open(recording);
  if (!states) return tl::unexpected(states.error());
  StampRange stamps;
  std::optional<RecordedState> first, last;
  while (true) {
    auto state = states->next();
    if (!state) return tl::unexpected(state.error());
    if (!*state) break;
    last = std::move(**state);
    if (!first) first = last;
    if (range.from && !is_reached(*range.from, *last)) continue;
    if (range.to && is_passed(*range.to, *last)) continue;
    const bool is_first = stamps.sets++ == 0;
    if (range.from) stamps.first = is_first ? last->utc : std::min(stamps.first, last->utc);
    if (range.to) stamps.last = is_first ? last->utc : std::max(stamps.last, last->utc);
  }
  if (!last) return fail(recording.string() + ": no state of the process, so no frame set");
  if (stamps.sets > 0) return stamps;
  return fail(recording.string() + ": no frame set in this range; it has " + name_of(*first) +
              " to " + name_of(*last));
}

}  // namespace orbwatch::app::recorder
