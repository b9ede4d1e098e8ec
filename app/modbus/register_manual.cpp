#include "app/modbus/register_manual.h"

#include <array>
#include <charconv>
#include <span>
#include <string_view>
#include <vector>

#include "app/modbus/bits.h"
#include "app/modbus/codes.h"
#include "app/modbus/manual_text.h"
#include "app/modbus/register_map.h"

namespace orbwatch::app {
namespace {

using namespace modbus;

/// The shortest decimal number that reads back as the same, never with an exponent.
std::string decimal(double number) {
  std::array<char, 400> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed).ptr;
  return {text.data(), end};
}

/// A field of RFC 4180.
std::string field(std::string_view text) {
  if (text.find_first_of(",\"\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char letter : text)
    quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
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

std::string range_of(const Row& row) {
  return row.read ? decimal(row.minimum) + " to " + decimal(row.maximum) : "";
}

/// The rows of a table with addresses in [from, to).
std::string rows_between(const RegisterMap& map, Table table, int from, int to) {
  std::string text = table_head(
      {"address", "count", "type", "access", "name", "scale", "unit", "range", "description"});
  for (const Row& row : map.rows()) {
    if (row.table != table || row.address < from || row.address >= to) continue;
    text +=
        table_line({std::to_string(row.address), std::to_string(row.count),
                    std::string(name_of(row.type)), std::string(name_of(row.access)), row.name,
                    row.read ? decimal(row.scale) : "", row.unit, range_of(row), row.description});
  }
  return text;
}

/// All bits; of those that repeat, the first.
std::string bit_rows(const RegisterMap& map) {
  const auto rows = [&map](int from, int to) {
    return rows_between(map, Table::Discrete, from, to) + "\n";
  };
  return rows(kStatusBits, kProcessInputBits) + "Process input *n* is " +
         std::to_string(kProcessInputBits) + " + *n*, up to *n* = 31.\n\n" +
         rows(kProcessInputBits, kProcessInputBits + 1) +
         "Alarm *n* stands *n* - 1 further, up to *n* = " + std::to_string(signals::kMaxAlarms) +
         ".\n\n" + rows(kActiveBits, kActiveBits + 1) +
         rows(kUnacknowledgedBits, kUnacknowledgedBits + 1);
}

std::string code_table(const std::vector<Code>& codes) {
  std::string text = table_head({"code", "meaning"});
  for (const Code& code : codes) text += table_line({std::to_string(code.number), code.meaning});
  return text;
}

std::string range_of(const ArgumentInfo& argument) {
  return decimal(argument.minimum) + " to " + decimal(argument.maximum);
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
                          decimal(argument.scale), std::string(argument.unit), range_of(argument),
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

std::string repeated(const std::string& thing, int first, std::size_t count, int stride) {
  const std::string entry = thing + " *n*";
  const std::string factor = first == 0 ? "*n*" : "(*n* - " + std::to_string(first) + ")";
  return "Shown for " + thing + " " + std::to_string(first) + "; " + entry + " stands " +
         std::to_string(stride) + " x " + factor +
         " registers further, up to *n* = " + std::to_string(static_cast<int>(count) - 1 + first) +
         ".\n\n";
}

}  // namespace

std::string registers_csv() {
  std::string text = "table,address,count,type,access,name,scale,unit,min,max,description\n";
  const RegisterMap map;
  for (const Row& row : map.rows()) {
    const std::array<std::string, 11> cells{std::string(name_of(row.table)),
                                            std::to_string(row.address),
                                            std::to_string(row.count),
                                            std::string(name_of(row.type)),
                                            std::string(name_of(row.access)),
                                            field(row.name),
                                            decimal(row.scale),
                                            field(row.unit),
                                            decimal(row.minimum),
                                            decimal(row.maximum),
                                            field(row.description)};
    text += joined(cells, ",") + "\n";
  }
  return text;
}

std::string registers_markdown() {
  const RegisterMap map;
  const auto input = [&map](int from, int to) {
    return rows_between(map, Table::Input, from, to) + "\n";
  };
  std::string text = manual_text(map);
  text += "## Discrete inputs\n\n" + bit_rows(map);
  text += "## Input registers: system\n\n" + input(kSystemBlock, kHealthBlock);
  text += "## Input registers: health\n\n" + input(kHealthBlock, kCameraBlock);
  text += "## Input registers: cameras\n\n" + repeated("camera", 0, kMaxCameras, kCameraStride) +
          input(kCameraBlock, kCameraBlock + kCameraStride);
  text += "## Input registers: views\n\n" + repeated("view", 0, kMaxViews, kViewStride) +
          input(kViewBlock, kViewBlock + kViewStride);
  text += "## Input registers: alarms\n\n" + input(kAlarmBlock, kFirstAlarm) +
          repeated("alarm", 1, signals::kMaxAlarms, kAlarmStride) +
          input(kFirstAlarm, kFirstAlarm + kAlarmStride);
  text += "## Input registers: regions and results\n\n" +
          repeated("region", 0, signals::kMaxRegions, kRegionStride) +
          "The window of results from " + std::to_string(kResultBlock) +
          " on has the same structure; its rows are called `result_` instead of `region_`. Signal "
          "*n*, counted from 0, is the one at " +
          std::to_string(kLiveBlock + kRegionSignals) + " + 2 x *n*.\n\n" +
          input(kLiveBlock, kLiveBlock + kRegionStride);
  text += "## Holding registers: what the PLC writes\n\n" +
          rows_between(map, Table::Holding, 0, kMirrorOffset) + "\n";
  text += "## Commands and their arguments\n\n" + command_table() + "\n";
  text += "## Command results\n\n" + code_table(command_result_codes()) + "\n";
  text += "## System states\n\n" + code_table(system_state_codes()) + "\n";
  text += "## Fault bits\n\n" + bit_table(fault_bits()) + "\n";
  text += "## Camera faults\n\n" + code_table(camera_fault_codes()) + "\n";
  text += "## Alarm states\n\n" + code_table(alarm_state_codes()) + "\n";
  text += "## Alarm levels\n\n" + code_table(alarm_level_codes());
  return text;
}

}  // namespace orbwatch::app
