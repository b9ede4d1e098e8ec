// SPDX-License-Identifier: Apache-2.0
#include "app/cli/command_words.h"

#include <charconv>

namespace orbwatch::app::cli {
namespace {

std::string capitals(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return result;
}

/// Usage such as "point_view VIEW YAW PITCH H_FOV".
std::string usage(const CommandInfo& info) {
  std::string text(info.name);
  for (std::size_t i = 0; i < info.argument_count(); ++i) {
    text += " " + capitals(info.arguments[i].name);
  }
  return text;
}

}  // namespace

Result<Command> parse_command(const std::vector<std::string>& words) {
  const CommandInfo* info = words.empty() ? nullptr : find_command(words.front());
  if (!info) {
    return fail(words.empty() ? "say which command" : "there is no command " + words.front());
  }
  if (words.size() != 1 + info->argument_count()) {
    return fail("its form is: " + usage(*info));
  }
  Command command{info->code, {}};
  for (std::size_t i = 0; i < info->argument_count(); ++i) {
    const std::string& word = words[i + 1];
    const char* end = word.data() + word.size();
    const auto [parsed, error] = std::from_chars(word.data(), end, command.arguments[i]);
    if (error != std::errc() || parsed != end) {
      return fail(std::string(info->arguments[i].name) + " is \"" + word + "\"; it must be " +
                  range_text(info->arguments[i]));
    }
  }
  if (check(command) != CommandResult::Done) return fail(refusal_text(command));
  return command;
}

std::string commands_help() {
  std::string text;
  for (const CommandInfo& info : kCommands) {
    text += "  " + usage(info) + "\n      " + std::string(info.description) + "\n";
    for (std::size_t i = 0; i < info.argument_count(); ++i) {
      const ArgumentInfo& argument = info.arguments[i];
      text += "      " + capitals(argument.name) + ": " + std::string(argument.description) + " (" +
              range_text(argument) + ")\n";
    }
  }
  return text;
}

}  // namespace orbwatch::app::cli
