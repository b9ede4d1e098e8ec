// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/model/plain_text.h"
#include "app/ports/web/api/changes.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/recordings/recording_records.h"

namespace orbwatch::app::web {

/// MCAP has no registered media type.
inline constexpr std::string_view kMcap = "application/octet-stream";

/// Name of an event for the audit, cut to 100 bytes: it is any text of a client. Reentrant.
inline std::string event_for_audit(std::string_view event) { return plain_text(event, 100); }

/// Serves the recorder's events. Thread-safe.
class RecordingRoutes {
 public:
  /// `events` null: no events are recorded. `regions`: of their recipes. `changes`: the thread that
  /// waits for the disk; outlives it.
  RecordingRoutes(std::shared_ptr<RecordedEvents> events, RecordedRegionsReader regions,
                  Changes& changes)
      : events_(std::move(events)), regions_(std::move(regions)), changes_(changes) {}

  void list(const RecordingsQuery& query, const ExchangePtr& exchange) const;
  void picture(const EventQuery& query, const ExchangePtr& exchange) const;
  void frames(const EventQuery& query, const ExchangePtr& exchange) const;
  void frame(const FrameQuery& query, const ExchangePtr& exchange) const;
  void signals(const EventQuery& query, const ExchangePtr& exchange) const;
  void signal(const SignalQuery& query, const ExchangePtr& exchange) const;
  void regions(const EventQuery& query, const ExchangePtr& exchange) const;
  void recording(const EventQuery& query, const ExchangePtr& exchange) const;
  Answered<Done> pin(Change<PinBody>& change) const;
  Answered<Done> remove(Change<EventQuery>& change) const;

 private:
  /// Answers by `handle`, on the thread that waits for the disk; 404 without a recorder of events.
  void read(const ExchangePtr& exchange,
            std::function<Response(RecordedEvents& events)> handle) const;

  const std::shared_ptr<RecordedEvents> events_;
  const RecordedRegionsReader regions_;
  Changes& changes_;
};

}  // namespace orbwatch::app::web
