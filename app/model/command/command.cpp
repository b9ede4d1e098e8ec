// SPDX-License-Identifier: Apache-2.0
#include "app/model/command/command.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace orbwatch::app {
namespace {

bool is_allowed(double value, const ArgumentInfo& argument) {
  if (!(value >= argument.minimum && value <= argument.maximum)) return false;  // rejects NaN, too
  return argument.scale != 1 || value == std::floor(value);
}

/// Returns false if the argument must be below the next one and is not.
bool is_in_order(const Command& command, const CommandInfo& info, std::size_t i) {
  return !info.arguments[i].is_below_next || command.arguments[i] < command.arguments[i + 1];
}

/// Shortest text that parses to the same value.
std::string number_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

const CommandInfo* find_command(CommandCode code) {
  const auto* const found = std::ranges::find(kCommands, code, &CommandInfo::code);
  return found == kCommands.end() ? nullptr : &*found;
}

const CommandInfo* find_command(std::string_view name) {
  const auto found = std::ranges::find(kCommands, name, &CommandInfo::name);
  return found == kCommands.end() ? nullptr : &*found;
}

CommandResult check(const Command& command) {
  const CommandInfo* info = find_command(command.code);
  if (!info) return CommandResult::UnknownCommand;
  for (std::size_t i = 0; i < info->argument_count(); ++i) {
    if (!is_allowed(command.arguments[i], info->arguments[i]) || !is_in_order(command, *info, i)) {
      return CommandResult::ArgumentOutOfRange;
    }
  }
  return CommandResult::Done;
}

std::string range_text(const ArgumentInfo& argument) {
  std::string text = argument.scale == 1 ? "a whole number, " : "";
  text += number_text(argument.minimum) + " to " + number_text(argument.maximum);
  return argument.unit.empty() ? text : text + " " + std::string(argument.unit);
}

std::string refusal_text(const Command& command) {
  const CommandInfo* info = find_command(command.code);
  if (!info) return std::string(operator_text(CommandResult::UnknownCommand));
  for (std::size_t i = 0; i < info->argument_count(); ++i) {
    const ArgumentInfo& argument = info->arguments[i];
    if (is_allowed(command.arguments[i], argument)) continue;
    return std::string(argument.name) + " is " + number_text(command.arguments[i]) +
           "; it must be " + range_text(argument);
  }
  for (std::size_t i = 0; i < info->argument_count(); ++i) {
    if (is_in_order(command, *info, i)) continue;
    return std::string(info->arguments[i].name) + " is " + number_text(command.arguments[i]) +
           "; it must be below " + std::string(info->arguments[i + 1].name) + ", which is " +
           number_text(command.arguments[i + 1]);
  }
  return {};
}

}  // namespace orbwatch::app
