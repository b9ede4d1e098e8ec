// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/export_range.h"

#include <algorithm>
#include <charconv>
#include <ctime>
#include <string>

#include "app/ports/recorder/recorded_states.h"
#include "app/ports/recorder/recorded_utc.h"
#include "hal/calendar_time.h"

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

/// Nanoseconds of ".125"; none without a fraction.
std::optional<std::uint64_t> parse_fraction(std::string_view text) {
  constexpr std::size_t kDigits = 9;
  if (text.empty()) return 0;
  if (text.front() != '.' || text.size() < 2 || text.size() > kDigits + 1) return std::nullopt;
  std::string digits(text.substr(1));
  digits.resize(kDigits, '0');
  return parse_digits(digits);
}

/// Parses 2026-11-28T09:22:00.125Z.
std::optional<std::uint64_t> parse_moment(std::string_view text) {
  constexpr std::string_view kForm = "0000-00-00T00:00:00";
  const bool has_form =
      text.size() > kForm.size() && text.ends_with('Z') &&
      std::ranges::equal(text.substr(0, kForm.size()), kForm, [](char given, char form) {
        return form == '0' ? given >= '0' && given <= '9' : given == form;
      });
  if (!has_form) return std::nullopt;
  const auto part = [&](std::size_t at, std::size_t digits) {
    return static_cast<int>(parse_digits(text.substr(at, digits)).value_or(0));
  };
  std::tm fields{};
  fields.tm_year = part(0, 4) - 1900;
  fields.tm_mon = part(5, 2) - 1;
  fields.tm_mday = part(8, 2);
  fields.tm_hour = part(11, 2);
  fields.tm_min = part(14, 2);
  fields.tm_sec = part(17, 2);
  const auto second = hal::moment_of(fields);
  const std::tm carried = hal::calendar_time(second);
  const bool is_date = carried.tm_mday == fields.tm_mday && carried.tm_mon == fields.tm_mon &&
                       carried.tm_hour == fields.tm_hour && carried.tm_min == fields.tm_min;
  const auto rest = parse_fraction(text.substr(kForm.size(), text.size() - kForm.size() - 1));
  const auto since_1970 = second.time_since_epoch().count();
  if (!is_date || !rest || since_1970 < 0) return std::nullopt;
  return static_cast<std::uint64_t>(since_1970) * 1'000'000'000 + *rest;
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
  if (const auto moment = parse_moment(text)) return RangeEnd{true, *moment};
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
