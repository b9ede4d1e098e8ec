// SPDX-License-Identifier: Apache-2.0
#include "app/model/status/utc_text.h"

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "hal/calendar_time.h"

namespace orbwatch::app {
namespace {

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

/// True if the digits are where the form has zeros, and its other characters where it has them.
bool has_form(std::string_view text, std::string_view form) {
  return std::ranges::equal(text, form, [](char given, char wanted) {
    return wanted == '0' ? is_digit(given) : given == wanted;
  });
}

std::uint64_t value_of(std::string_view digits) {
  std::uint64_t value = 0;
  for (const char digit : digits) value = 10 * value + static_cast<std::uint64_t>(digit - '0');
  return value;
}

/// Nanoseconds of ".125"; none without a fraction.
std::optional<std::uint64_t> parse_fraction(std::string_view text) {
  constexpr std::size_t kDigits = 9;
  if (text.empty()) return 0;
  if (text.front() != '.' || text.size() < 2 || text.size() > kDigits + 1) return std::nullopt;
  std::string digits(text.substr(1));
  if (!std::ranges::all_of(digits, is_digit)) return std::nullopt;
  digits.resize(kDigits, '0');
  return value_of(digits);
}

}  // namespace

std::optional<std::string> utc_text(std::chrono::system_clock::time_point moment) {
  if (moment == std::chrono::system_clock::time_point{}) return std::nullopt;
  const auto second = std::chrono::floor<std::chrono::seconds>(moment);
  const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(moment - second).count();
  const std::tm fields = hal::calendar_time(second);
  char text[64];
  const std::size_t length = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &fields);
  std::snprintf(text + length, sizeof text - length, ".%09lldZ", static_cast<long long>(rest));
  return text;
}

std::optional<std::uint64_t> parse_utc_text(std::string_view text) {
  constexpr std::string_view kForm = "0000-00-00T00:00:00";
  const bool is_moment = text.size() > kForm.size() && text.ends_with('Z') &&
                         has_form(text.substr(0, kForm.size()), kForm);
  if (!is_moment) return std::nullopt;
  const auto part = [&](std::size_t at, std::size_t digits) {
    return static_cast<int>(value_of(text.substr(at, digits)));
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

std::optional<std::string> compact_utc_text(std::chrono::system_clock::time_point moment) {
  auto text = utc_text(moment);
  if (!text) return text;
  std::erase_if(*text, [](char c) { return c == '-' || c == ':'; });
  return text->substr(0, kCompactUtcLength - 1) + "Z";
}

bool is_compact_utc_text(std::string_view text) { return has_form(text, "00000000T000000.000Z"); }

}  // namespace orbwatch::app
