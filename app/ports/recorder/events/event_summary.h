// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/model/sink/recorded_events.h"
#include "app/ports/recorder/events/event_triggers.h"
#include "app/ports/recorder/messages.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Cause and contents of an event: summary.json in its folder.
struct EventSummary {
  std::string trigger;                 ///< name of the kind
  std::string text;                    ///< for operators, one line
  std::optional<AlarmCause> alarm;     ///< empty: another trigger, or an earlier version wrote it
  std::string line;                    ///< name of a digital line; empty: likewise
  std::string first, triggered, last;  ///< UTC of frame sets; empty: no picture
  std::uint64_t frame_set = 0;         ///< of the trigger
  std::uint16_t recipe = 0;
  std::string part;                                             ///< empty: not known
  double layer = signals::kNotValid;                            ///< of the part
  std::vector<std::pair<std::string, std::uint64_t>> pictures;  ///< by camera
  std::uint64_t lost = 0;       ///< pictures that found no room while it was recorded
  bool has_beginning = true;    ///< false: pictures before the trigger were not there any more
  bool is_interrupted = false;  ///< it was not recorded to its end
  std::vector<std::pair<std::string, std::string>> versions;
};

/// Names of the files in the folder of an event.
inline constexpr const char* kEventFile = "event.mcap";
inline constexpr const char* kEventSummary = "summary.json";
inline constexpr const char* kEventPicture = "trigger.jpg";
inline constexpr const char* kEventPin = "pinned";

/// JSON of a summary. Reentrant.
std::string summary_text(const EventSummary& summary);

/// Errors: of the disk.
Result<> write_summary(const std::filesystem::path& folder, const EventSummary& summary);

/// The summary in a text of any origin. Error: it is not one; the text is not quoted. Reentrant.
Result<EventSummary> parse_summary(std::string_view text);

/// Errors: missing, unreadable, or not a summary.
Result<EventSummary> read_summary(const std::filesystem::path& folder);

}  // namespace orbwatch::app::recorder
