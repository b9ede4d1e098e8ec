// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/ports/recorder/events/event_folder.h"
#include "app/ports/recorder/events/event_summary.h"

namespace orbwatch::app::cli {

// All reentrant.

/// One line per event.
std::string stored_events_text(const std::vector<recorder::StoredEvent>& events);
std::string stored_events_json(const std::vector<recorder::StoredEvent>& events);

/// One line per fact.
std::string stored_event_text(const recorder::StoredEvent& event,
                              const recorder::EventSummary& summary);
std::string stored_event_json(const recorder::StoredEvent& event,
                              const recorder::EventSummary& summary);

}  // namespace orbwatch::app::cli
