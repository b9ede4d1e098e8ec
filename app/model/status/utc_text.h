// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orbwatch::app {

/// A moment in ISO 8601 with nanoseconds: "2026-11-21T20:57:46.000000000Z"; nullopt for the epoch,
/// which stands for "never". Reentrant.
std::optional<std::string> utc_text(std::chrono::system_clock::time_point moment);

/// Nanoseconds since 1970 of a moment such as "2026-11-28T09:22:00.125Z", with up to nine digits of
/// a fraction or none; nullopt: another form, no date, or before 1970. Reentrant.
std::optional<std::uint64_t> parse_utc_text(std::string_view text);

/// A moment for names of files, with milliseconds: "20260131T235959.123Z"; nullopt as utc_text().
/// Names sort as their moments do. Reentrant.
std::optional<std::string> compact_utc_text(std::chrono::system_clock::time_point moment);
inline constexpr std::size_t kCompactUtcLength = 20;

/// True for a text of that form, whatever its digits. Reentrant.
bool is_compact_utc_text(std::string_view text);

}  // namespace orbwatch::app
