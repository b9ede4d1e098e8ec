// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_summary.h"

#include <cmath>
#include <concepts>
#include <exception>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "hal/atomic_file.h"
#include "hal/regular_file.h"

namespace orbwatch::app::recorder {
namespace {

using Json = nlohmann::ordered_json;

/// A summary has a few lines per camera and library.
constexpr std::size_t kLongestSummary = 64 << 10;

/// Null for a text or a number that is not known.
Json known(const std::string& text) { return text.empty() ? Json() : Json(text); }
Json known(double number) { return std::isfinite(number) ? Json(number) : Json(); }

template <class Value>
Json object_of(const std::vector<std::pair<std::string, Value>>& entries) {
  Json object = Json::object();
  for (const auto& [name, value] : entries) object[name] = value;
  return object;
}

Json json_of(const std::optional<AlarmCause>& alarm) {
  if (!alarm) return {};
  return Json{{"region", alarm->region},
              {"signal", alarm->signal},
              {"level", static_cast<int>(alarm->level)},
              {"value", known(alarm->value)},
              {"unit", alarm->unit}};
}

void read(const Json& value, std::string& text) { text = value.get<std::string>(); }

/// The library converts any number, also one that the type does not have.
template <std::unsigned_integral Number>
void read(const Json& value, Number& number) {
  constexpr std::uint64_t kMost = std::numeric_limits<Number>::max();
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kMost) {
    throw std::range_error("a number is not a whole one from 0 to " + std::to_string(kMost));
  }
  number = value.get<Number>();
}

template <class Value>
void read_object(const Json& object, std::vector<std::pair<std::string, Value>>& entries) {
  for (const auto& [name, value] : object.items()) {
    read(value, entries.emplace_back(name, Value()).second);
  }
}

void read_known(const Json& value, std::string& text) {
  if (!value.is_null()) text = value.get<std::string>();
}

void read(const Json& value, signals::AlarmLevel& level) {
  std::uint8_t number = 0;
  read(value, number);
  level = static_cast<signals::AlarmLevel>(number);
  if (signals::operator_text(level).empty()) {
    throw std::range_error("there is no level " + std::to_string(number) + " of an alarm");
  }
}

AlarmCause alarm_of(const Json& json) {
  AlarmCause alarm;
  read(json.at("region"), alarm.region);
  read(json.at("signal"), alarm.signal);
  read(json.at("level"), alarm.level);
  if (!json.at("value").is_null()) alarm.value = json.at("value").get<double>();
  read(json.at("unit"), alarm.unit);
  return alarm;
}

/// Members that earlier versions do not write.
void read_cause(const Json& json, EventSummary& summary) {
  const auto alarm = json.find("alarm"), line = json.find("line");
  if (alarm != json.end() && !alarm->is_null()) summary.alarm = alarm_of(*alarm);
  if (line != json.end()) read_known(*line, summary.line);
}

EventSummary summary_of(const Json& json) {
  EventSummary summary;
  summary.trigger = json.at("trigger").get<std::string>();
  summary.text = json.at("text").get<std::string>();
  read_cause(json, summary);
  read_known(json.at("first"), summary.first);
  read_known(json.at("triggered"), summary.triggered);
  read_known(json.at("last"), summary.last);
  read(json.at("frame_set"), summary.frame_set);
  read(json.at("recipe"), summary.recipe);
  read_known(json.at("part"), summary.part);
  if (!json.at("layer").is_null()) summary.layer = json.at("layer").get<double>();
  read_object(json.at("pictures"), summary.pictures);
  read(json.at("lost"), summary.lost);
  summary.has_beginning = json.at("has_beginning").get<bool>();
  summary.is_interrupted = json.at("is_interrupted").get<bool>();
  read_object(json.at("versions"), summary.versions);
  return summary;
}

}  // namespace

std::string summary_text(const EventSummary& summary) {
  const Json json{{"trigger", summary.trigger},
                  {"text", summary.text},
                  {"alarm", json_of(summary.alarm)},
                  {"line", known(summary.line)},
                  {"first", known(summary.first)},
                  {"triggered", known(summary.triggered)},
                  {"last", known(summary.last)},
                  {"frame_set", summary.frame_set},
                  {"recipe", summary.recipe},
                  {"part", known(summary.part)},
                  {"layer", known(summary.layer)},
                  {"pictures", object_of(summary.pictures)},
                  {"lost", summary.lost},
                  {"has_beginning", summary.has_beginning},
                  {"is_interrupted", summary.is_interrupted},
                  {"versions", object_of(summary.versions)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<> write_summary(const std::filesystem::path& folder, const EventSummary& summary) {
  return hal::write_file(folder / kEventSummary, summary_text(summary));
}

Result<EventSummary> parse_summary(std::string_view text) {
  try {
    return summary_of(Json::parse(text));
  } catch (const Json::parse_error& error) {
    return fail("not JSON at byte " + std::to_string(error.byte));
  } catch (const std::exception& error) {
    return fail(std::string("not a summary of an event: ") + error.what());
  }
}

Result<EventSummary> read_summary(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kEventSummary;
  const auto text = hal::read_regular_file(file, kLongestSummary);
  if (!text) return tl::unexpected(text.error());
  return parse_summary(*text).map_error(
      [&](const Error& error) { return Error{file.string() + ": " + error.message}; });
}

}  // namespace orbwatch::app::recorder
