// SPDX-License-Identifier: Apache-2.0
#include "app/cli/list/list_text.h"

#include <nlohmann/json.hpp>

#include "app/cli/text_table.h"
#include "app/model/status/json.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/fleet/fleet_records.h"

namespace orbwatch::app::cli {
namespace {

using Json = nlohmann::ordered_json;

template <class Entry>
Json list_of(const std::vector<Entry>& entries);

Json json_of(double number) { return to_json(number); }
Json json_of(const std::string& text) { return text; }

Json json_of(const hal::CameraMode& mode) {
  return {{"format", mode.format}, {"size", mode.size}, {"frame_rates", list_of(mode.frame_rates)}};
}

Json json_of(const hal::CameraControl& control) {
  return {{"control", control.name},
          {"minimum", json_of(control.minimum)},
          {"maximum", json_of(control.maximum)},
          {"step", json_of(control.step)},
          {"default", json_of(control.default_value)},
          {"state", control.state},
          {"values", list_of(control.values)}};
}

Json json_of(const hal::CameraEntry& camera) {
  return {{"camera", camera.id},
          {"back_end", camera.back_end},
          {"model", camera.model},
          {"driver", camera.driver},
          {"bus", camera.bus},
          {"paths", list_of(camera.paths)},
          {"problem", camera.problem},
          {"advice", camera.advice},
          {"modes", list_of(camera.modes)},
          {"controls", list_of(camera.controls)}};
}

Json json_of(const hal::LineInfo& line) {
  const bool anonymous = line.is_used && line.consumer.empty();
  return {{"line", line.offset},
          {"name", line.name},
          {"direction", line.is_output ? "output" : "input"},
          {"consumer", anonymous ? "in use" : line.consumer}};
}

Json json_of(const hal::ChipInfo& chip) {
  return {{"chip", chip.label},
          {"path", chip.path},
          {"problem", chip.error},
          {"lines", list_of(chip.lines)}};
}

template <class Entry>
Json list_of(const std::vector<Entry>& entries) {
  Json list = Json::array();
  for (const Entry& entry : entries) list.push_back(json_of(entry));
  return list;
}

Json json_of(const hal::Inventory& inventory) {
  return {{"cameras", list_of(inventory.cameras)}, {"chips", list_of(inventory.chips)}};
}

/// Text of a text or number, or of a list of those.
std::string cell(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.is_null() ? "" : value.dump();
  std::string list;
  for (const Json& item : value) list += (list.empty() ? "" : ", ") + cell(item);
  return list;
}

bool is_table(const Json& value) {
  return value.is_array() && !value.empty() && value[0].is_object();
}

Fields fields_of(const Json& entry) {
  Fields fields;
  for (const auto& [name, value] : entry.items()) {
    if (!is_table(value)) fields.emplace_back(name, cell(value));
  }
  return fields;
}

/// One line for each of its fields, one table for each of its lists.
std::string entry_text(const Json& entry) {
  std::string text = field_lines(fields_of(entry));
  for (const Json& value : entry) {
    if (!is_table(value)) continue;
    std::vector<Fields> records;
    for (const Json& record : value) records.push_back(fields_of(record));
    text += "\n" + record_lines(records);
  }
  return text;
}

}  // namespace

std::string list_json(const hal::Inventory& inventory) {
  return json_of(inventory).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string list_table(const hal::Inventory& inventory) {
  std::string text;
  const Json all = json_of(inventory);
  for (const auto& [kind, entries] : all.items()) {
    for (const Json& entry : entries) text += entry_text(entry) + "\n";
    if (entries.empty()) text += "no " + kind + "\n";
  }
  return text;
}

std::string appliances_json(const std::vector<Fleet::Entry>& appliances, hal::TimePoint now) {
  auto sent = web::sent_appliances(appliances, now);
  return Json{{"appliances", web::json_of(sent)}}.dump(2) + "\n";
}

std::string appliances_table(const std::vector<Fleet::Entry>& appliances) {
  std::vector<Fields> records;
  for (const Fleet::Entry& entry : appliances) {
    const ApplianceNotice& notice = entry.notice;
    records.push_back({{"name", notice.name},
                       {"state", entry.is_gone ? "gone" : std::string(name_of(notice.state))},
                       {"alarms", std::to_string(notice.alarms)},
                       {"alarm", notice.alarm.text.empty() ? kNoValue : notice.alarm.text},
                       {"page", notice.page.address.empty() ? kNoValue : url_of(notice.page)},
                       {"version", notice.version},
                       {"prefix", notice.prefix}});
  }
  return record_lines(records);
}

}  // namespace orbwatch::app::cli
