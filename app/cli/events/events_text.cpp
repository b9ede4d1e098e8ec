// SPDX-License-Identifier: Apache-2.0
#include "app/cli/events/events_text.h"

#include <nlohmann/json.hpp>

#include "app/cli/text_table.h"

namespace orbwatch::app::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string printed(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string mebibytes(std::uint64_t bytes) {
  constexpr double kMebibyte = 1 << 20;
  return fixed_text(static_cast<double>(bytes) / kMebibyte, 1);
}

Json object_of(const recorder::StoredEvent& event) {
  return {{"name", event.name},
          {"folder", event.folder.string()},
          {"bytes", event.bytes},
          {"pinned", event.is_pinned},
          {"finished", event.is_finished}};
}

std::string yes(bool truth) { return truth ? "yes" : ""; }

}  // namespace

std::string stored_events_text(const std::vector<recorder::StoredEvent>& events) {
  if (events.empty()) return "no event is recorded\n";
  std::vector<Fields> records;
  records.reserve(events.size());
  for (const recorder::StoredEvent& event : events) {
    records.push_back({{"name", event.name},
                       {"MiB", mebibytes(event.bytes)},
                       {"pinned", yes(event.is_pinned)},
                       {"being_recorded", yes(recorder::EventFolder::is_being_recorded(event))}});
  }
  return record_lines(records);
}

std::string stored_events_json(const std::vector<recorder::StoredEvent>& events) {
  Json json{{"events", Json::array()}};
  for (const recorder::StoredEvent& event : events) json["events"].push_back(object_of(event));
  return printed(json);
}

std::string stored_event_text(const recorder::StoredEvent& event,
                              const recorder::EventSummary& summary) {
  Fields fields{{"name", event.name},
                {"trigger", summary.trigger},
                {"text", summary.text},
                {"first", summary.first},
                {"triggered", summary.triggered},
                {"last", summary.last},
                {"frame_set", std::to_string(summary.frame_set)},
                {"recipe", std::to_string(summary.recipe)},
                {"part", summary.part},
                {"layer", fixed_text(summary.layer, 0)}};
  for (const auto& [camera, pictures] : summary.pictures) {
    fields.emplace_back("pictures of " + camera, std::to_string(pictures));
  }
  fields.emplace_back("lost pictures", std::to_string(summary.lost));
  fields.emplace_back("beginning is missing", yes(!summary.has_beginning));
  fields.emplace_back("interrupted", yes(summary.is_interrupted));
  fields.emplace_back("pinned", yes(event.is_pinned));
  fields.emplace_back("MiB", mebibytes(event.bytes));
  fields.emplace_back("folder", event.folder.string());
  return field_lines(fields);
}

std::string stored_event_json(const recorder::StoredEvent& event,
                              const recorder::EventSummary& summary) {
  Json json = object_of(event);
  json["summary"] = Json::parse(recorder::summary_text(summary));
  return printed(json);
}

}  // namespace orbwatch::app::cli
