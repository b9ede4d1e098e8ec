// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/ports/web/recordings/recording_records.h"

namespace orbwatch::app::web {

/// Answers a query from all events, the oldest first. Reentrant.
RecordingsAnswer search_events(const std::vector<RecordedEvent>& events,
                               const RecordingsQuery& query);

}  // namespace orbwatch::app::web
