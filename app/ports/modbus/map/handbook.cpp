// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/map/handbook.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <functional>
#include <map>
#include <span>
#include <stdexcept>
#include <vector>

#include "app/model/csv_text.h"
#include "app/ports/modbus/map/bits.h"
#include "app/ports/modbus/map/encoding.h"
#include "app/ports/modbus/map/register_map.h"
#include "app/ports/modbus/modbus_settings.h"
#include "app/state/slot_file.h"

namespace orbwatch::app {
namespace {

using namespace modbus;
using Texts = std::map<std::string, std::string, std::less<>>;

/// The shortest decimal text that parses to the same number, never with an exponent.
std::string decimal(double number) {
  std::array<char, 400> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed).ptr;
  return {text.data(), end};
}

std::string joined(std::span<const std::string> cells, std::string_view separator) {
  std::string line;
  for (const std::string& cell : cells) {
    if (&cell != cells.data()) line += separator;
    line += cell;
  }
  return line;
}

std::string table_line(const std::vector<std::string>& cells) {
  return "| " + joined(cells, " | ") + " |\n";
}

std::string table_head(const std::vector<std::string>& cells) {
  return table_line(cells) + table_line(std::vector<std::string>(cells.size(), "---"));
}

std::string range_text(double minimum, double maximum) {
  return decimal(minimum) + " to " + decimal(maximum);
}

/// The rows of a table in a section, including reserved ones.
std::string row_table(const RegisterMap& map, Table table, Section section) {
  std::string text = table_head(
      {"address", "count", "type", "access", "name", "scale", "unit", "range", "description"});
  for (const Row& row : map.rows()) {
    if (row.table != table || row.address < section.begin || row.address >= section.end) continue;
    const Quantity& q = row.quantity;
    const int count = std::min(row.count, section.end - row.address);
    text += table_line({std::to_string(row.address), std::to_string(count),
                        std::string(name_of(row.type)), std::string(name_of(row.access)), row.name,
                        row.read ? decimal(q.scale) : "", std::string(q.unit),
                        row.read ? range_text(q.minimum, q.maximum) : "", row.description});
  }
  return text;
}

std::string command_table() {
  std::string text =
      table_head({"code", "command", "argument", "name", "scale", "unit", "range", "description"});
  for (const CommandInfo& command : kCommands) {
    text += table_line({std::to_string(static_cast<int>(command.code)), std::string(command.name),
                        "", "", "", "", "", std::string(command.description)});
    for (std::size_t i = 0; i < command.argument_count(); ++i) {
      const ArgumentInfo& argument = command.arguments[i];
      text += table_line({"", "", std::to_string(i), std::string(argument.name),
                          decimal(argument.scale), std::string(argument.unit),
                          range_text(argument.minimum, argument.maximum),
                          std::string(argument.description)});
    }
  }
  return text;
}

std::string bit_table(const std::vector<Bit>& bits) {
  std::string text = table_head({"bit", "name", "description"});
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bits[i].is_set) text += table_line({std::to_string(i), bits[i].name, bits[i].description});
  }
  return text;
}

template <Enumeration Enum>
std::string code_table() {
  std::string text = table_head({"code", "meaning"});
  for (const CodeText& code : code_texts<Enum>()) {
    text += table_line({std::to_string(code.number), std::string(code.text)});
  }
  return text;
}

/// Addresses of blocks, numbers of entries, defaults.
Texts layout_numbers() {
  Texts texts;
  const auto set = [&texts](const std::string& name, long number) {
    texts[name] = std::to_string(number);
  };
  const auto block = [&set](const std::string& name, int address) {
    set(name, address);
    set(name + "+", address + kMirrorOffset);
  };
  const auto series = [&](const std::string& name, const Series& list) {
    block(name, list.begin);
    set(name + " STRIDE", list.stride);
  };
  block("SUMMARY", kSummary.begin);
  block("QUEUE", kResultQueue.begin);
  block("SYSTEM", kSystem.begin);
  block("HEALTH", kHealth.begin);
  block("PLC", kPlc.begin);
  block("SERVER", kServer.begin);
  block("MACHINE", kMachine.begin);
  block("RESULT MACHINE", kResultMachine.begin);
  set("STATE", kMachineState.begin);
  set("STATE COUNT", kWholeMachineState.size());
  block("ALARM SUMMARY", kAlarmSummary.begin);
  series("CAMERAS", kCameras);
  series("VIEWS", kViews);
  series("ALARMS", kAlarms);
  series("REGIONS", kRegions);
  series("RESULTS", kResults);
  set("LATER", kLaterParts.begin);
  set("LATER END", kLaterParts.end - 1);
  set("MORE REGIONS", kMoreOfRegions.begin);
  set("MORE RESULTS", kMoreOfResults.begin);
  set("MORE STRIDE", kMoreOfRegions.stride);
  set("PROCESS INPUTS", kProcessInputBits.begin);
  set("LAST CAMERA", kMaxCameras - 1);
  set("LAST VIEW", kMaxViews - 1);
  set("LAST REGION", signals::kMaxRegions - 1);
  set("ALARM COUNT", signals::kMaxAlarms);
  set("VERSION", kMapVersion);
  set("MIRROR", kMirrorOffset);
  set("SIGNALS", std::min(signals::kSignals.size(), kFirstSignals));
  set("DEPTH", kResultQueueDepth);
  // Two writes per command, for the command and its result; the example is a busy PLC.
  constexpr long kWrites = 2, kSecondsEach = 2, kCommands = 24 * 60 * 60 / kSecondsEach;
  set("SLOT", SlotFile::kSlotSize);
  set("FILE", SlotFile::kFileSize);
  set("SECONDS EACH", kSecondsEach);
  set("COMMANDS A DAY", kCommands);
  set("WRITES A DAY", kWrites * kCommands);
  set("MB A DAY", kWrites * kCommands * long{SlotFile::kSlotSize} / 1000000);
  set("INTERRUPTED", static_cast<long>(CommandResult::Interrupted));
  set("NOT CARRIED OUT", static_cast<long>(CommandResult::NotCarriedOut));
  const ModbusSettings defaults;
  set("PORT", defaults.port);
  set("STALE", std::chrono::duration_cast<std::chrono::seconds>(defaults.status_timeout).count());
  set("IDLE", std::chrono::duration_cast<std::chrono::seconds>(defaults.idle_time).count());
  return texts;
}

/// Address of each row and of its mirror.
Texts addresses(const RegisterMap& map) {
  Texts texts;
  for (const Row& row : map.rows()) {
    texts.emplace(row.name + (is_mirror(row) ? "+" : ""), std::to_string(row.address));
  }
  return texts;
}

Texts tables(const RegisterMap& map) {
  const auto input = [&map](Section section) { return row_table(map, Table::Input, section); };
  const auto bits = [&map](int begin, int end) {
    return row_table(map, Table::Discrete, {begin, end});
  };
  // The first one of repeated bits.
  const auto first = [&bits](Section section) { return bits(section.begin, section.begin + 1); };
  return {{"rows status bits", bits(kStatusBits.begin, kMeasurementBits.end)},
          {"rows process inputs", first(kProcessInputBits)},
          {"rows active bits", first(kActiveBits)},
          {"rows unacknowledged bits", first(kUnacknowledgedBits)},
          {"rows summary", input(kSummary)},
          {"rows queue", input(kResultQueue)},
          {"rows system", input(kSystem)},
          {"rows health", input(kHealth)},
          {"rows plc", input(kPlc)},
          {"rows server", input(kServer)},
          {"rows cameras", input(kCameras.entry(0))},
          {"rows views", input(kViews.entry(0))},
          {"rows alarm summary", input(kAlarmSummary)},
          {"rows alarms", input(kAlarms.entry(0))},
          {"rows regions", input(kRegions.entry(0))},
          {"rows more regions", input(kMoreOfRegions.entry(0))},
          {"rows machine", input(kMachine)},
          {"rows written", row_table(map, Table::Holding, kWritten)},
          {"rows machine state", row_table(map, Table::Holding, kMachineState)},
          {"commands", command_table()},
          {"fault bits", bit_table(fault_bits())},
          {"codes command results", code_table<CommandResult>()},
          {"codes system states", code_table<SystemState>()},
          {"codes camera faults", code_table<hal::Fault>()},
          {"codes alarm states", code_table<signals::AlarmState>()},
          {"codes alarm levels", code_table<signals::AlarmLevel>()}};
}

}  // namespace

std::string registers_csv() {
  std::string text = "table,address,count,type,access,name,scale,unit,min,max,description\n";
  const RegisterMap map;
  for (const Row& row : map.rows()) {
    const Quantity& q = row.quantity;
    const std::array<std::string, 11> cells{std::string(name_of(row.table)),
                                            std::to_string(row.address),
                                            std::to_string(row.count),
                                            std::string(name_of(row.type)),
                                            std::string(name_of(row.access)),
                                            csv_field(row.name),
                                            decimal(q.scale),
                                            csv_field(q.unit),
                                            decimal(q.minimum),
                                            decimal(q.maximum),
                                            csv_field(row.description)};
    text += joined(cells, ",") + "\n";
  }
  return text;
}

std::string registers_markdown() {
  const RegisterMap map;
  Texts texts = layout_numbers();
  texts.merge(tables(map));
  texts.merge(addresses(map));
  std::string text;
  std::string_view rest = kHandbookTemplate;
  for (auto at = rest.find('@'); at != rest.npos; at = rest.find('@')) {
    const auto end = rest.find('@', at + 1);
    const std::string_view name = rest.substr(at + 1, end - at - 1);
    const auto found = texts.find(name);
    if (found == texts.end()) throw std::out_of_range("handbook.md.in: " + std::string(name));
    text += rest.substr(0, at);
    text += found->second;
    rest.remove_prefix(end + 1);
  }
  return text + std::string(rest);
}

}  // namespace orbwatch::app
