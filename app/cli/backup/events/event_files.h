// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "app/ports/recorder/events/event_summary.h"

/// Files of an event in a backup.
namespace orbwatch::app::cli::backup {

inline constexpr std::array<std::string_view, 4> kEventFiles{
    recorder::kEventFile, recorder::kEventSummary, recorder::kEventPicture, recorder::kEventPin};
/// Bytes that are read and written at a time.
inline constexpr std::size_t kEventPart = std::size_t{128} << 10;

/// Beginning of the names of an event's files in its archive.
inline std::string name_above(const std::string& event) { return "events/" + event + "/"; }

}  // namespace orbwatch::app::cli::backup
