// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/commands/command_request.h"

#include <algorithm>

namespace orbwatch::app::dds {

namespace {

constexpr std::size_t kLongestName = std::ranges::max(kCommands, {}, [](const CommandInfo& info) {
                                       return info.name.size();
                                     }).name.size();

/// Usage in one line: "point_view takes 4 arguments: view yaw pitch h_fov".
std::string usage(const CommandInfo& info) {
  const std::size_t count = info.argument_count();
  std::string text = std::string(info.name) + " takes " + std::to_string(count) +
                     (count == 1 ? " argument" : " arguments");
  for (std::size_t i = 0; i < count; ++i) {
    text += (i == 0 ? ": " : " ") + std::string(info.arguments[i].name);
  }
  return text;
}

}  // namespace

CommandRequest request_of(const CommandMessage& message) {
  CommandRequest request{{message.client, message.number}, {}, {}, message.arguments._length};
  // Copies one character more than the longest name, so that a cut name stays unknown.
  for (const char* c = message.name; *c != '\0' && request.name.size() <= kLongestName; ++c) {
    request.name += *c;
  }
  std::copy_n(message.arguments._buffer, std::min(request.argument_count, kMaxArguments),
              request.arguments.begin());
  return request;
}

CommandAnswer carry_out(const CommandRequest& request, const CommandHandler& handler) {
  if (request.id.client == 0 || request.id.number == 0) {
    return {CommandResult::ArgumentOutOfRange, "client and number must not be 0"};
  }
  const CommandInfo* info = find_command(request.name);
  if (!info) {
    return {CommandResult::UnknownCommand,
            std::string(operator_text(CommandResult::UnknownCommand))};
  }
  if (request.argument_count != info->argument_count()) {
    return {CommandResult::ArgumentOutOfRange, usage(*info)};
  }
  const Command command{info->code, request.arguments, Giver("over DDS")};
  if (const CommandResult result = check(command); result != CommandResult::Done) {
    return {result, refusal_text(command)};
  }
  const CommandResult result = handler(command);
  return {result, std::string(operator_text(result))};
}

}  // namespace orbwatch::app::dds
