// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/recordings/recording_routes.h"

#include <utility>

#include "app/ports/web/api/json_form.h"
#include "app/ports/web/http/entity_tag.h"
#include "app/ports/web/recordings/event_search.h"

namespace orbwatch::app::web {
namespace {

constexpr const char* kNone = "no events are recorded: set [recorder.events]";

Response tagged(RecordingsAnswer answer) {
  Response response = json_response(json_text(json_of(answer)));
  response.tag = entity_tag(*response.body);
  return response;
}

/// A file of an event; 404: it is gone.
Response sent(const Result<std::filesystem::path>& path, std::string_view type) {
  const auto file = path.and_then(open_file);
  return file ? file_response(type, *file) : error_response(404, file.error().message);
}

}  // namespace

void RecordingRoutes::list(const RecordingsQuery& query, const ExchangePtr& exchange) const {
  changes_.read(exchange, [events = events_, query] {
    if (!events) {
      RecordingsAnswer none;
      none.missing = "[recorder.events]";
      return tagged(std::move(none));
    }
    const auto found = events->list();
    return found ? tagged(search_events(**found, query))
                 : error_response(503, found.error().message);
  });
}

void RecordingRoutes::read(const ExchangePtr& exchange,
                           std::function<Response(RecordedEvents& events)> handle) const {
  changes_.read(exchange, [events = events_, handle = std::move(handle)] {
    return events ? handle(*events) : error_response(404, kNone);
  });
}

void RecordingRoutes::picture(const EventQuery& query, const ExchangePtr& exchange) const {
  read(exchange, [event = query.event](const RecordedEvents& events) {
    return sent(events.picture(event), kJpeg);
  });
}

void RecordingRoutes::recording(const EventQuery& query, const ExchangePtr& exchange) const {
  read(exchange, [event = query.event](const RecordedEvents& events) {
    Response response = sent(events.recording(event), kMcap);
    // An event that was found has a name of letters, digits and "-_.".
    if (response.file) {
      response.headers.emplace_back("Content-Disposition",
                                    "attachment; filename=\"" + event + ".mcap\"");
    }
    return response;
  });
}

void RecordingRoutes::frames(const EventQuery& query, const ExchangePtr& exchange) const {
  read(exchange, [event = query.event](RecordedEvents& events) {
    auto frames = events.frames(event);
    if (!frames) return error_response(404, frames.error().message);
    FramesAnswer answer{std::move(*frames)};
    return json_response(json_text(json_of(answer)));
  });
}

void RecordingRoutes::frame(const FrameQuery& query, const ExchangePtr& exchange) const {
  read(exchange, [query](RecordedEvents& events) {
    auto jpeg = events.frame(query.event, query.camera, static_cast<std::size_t>(query.frame));
    return jpeg ? body_response(kJpeg, std::move(*jpeg))
                : error_response(404, jpeg.error().message);
  });
}

void RecordingRoutes::signals(const EventQuery& query, const ExchangePtr& exchange) const {
  read(exchange, [event = query.event](RecordedEvents& events) {
    auto signals = events.signals(event);
    if (!signals) return error_response(404, signals.error().message);
    SignalsAnswer answer{std::move(*signals)};
    return json_response(json_text(json_of(answer)));
  });
}

void RecordingRoutes::signal(const SignalQuery& query, const ExchangePtr& exchange) const {
  read(exchange, [query](RecordedEvents& events) {
    auto course = events.course(query.event, query.region, query.figure);
    if (!course) return error_response(404, course.error().message);
    return json_response(json_text(json_of(*course)));
  });
}

void RecordingRoutes::regions(const EventQuery& query, const ExchangePtr& exchange) const {
  read(exchange, [event = query.event, regions = regions_](RecordedEvents& events) {
    const auto recording = events.recording(event);
    if (!recording) return error_response(404, recording.error().message);
    auto changes = events.recipes(event);
    if (!changes) return error_response(404, changes.error().message);
    auto recipes = regions ? regions(*recording) : std::vector<RecordedRecipe>();
    if (!recipes) return error_response(409, recipes.error().message);
    RegionsAnswer answer{std::move(*changes), std::move(*recipes)};
    return json_response(json_text(json_of(answer)));
  });
}

Answered<Done> RecordingRoutes::pin(Change<PinBody>& change) const {
  const auto& [event, is_pinned] = change.body;
  change.after = event_for_audit(event) + (is_pinned ? " pinned" : " not pinned");
  if (!events_) return refuse(404, kNone);
  const auto pinned = events_->set_pinned(event, is_pinned);
  if (!pinned) return refuse(pinned.error());
  return Done{};
}

Answered<Done> RecordingRoutes::remove(Change<EventQuery>& change) const {
  change.after = event_for_audit(change.body.event) + " deleted";
  if (!events_) return refuse(404, kNone);
  const auto removed = events_->remove(change.body.event);
  if (!removed) return refuse(removed.error());
  return Done{};
}

}  // namespace orbwatch::app::web
