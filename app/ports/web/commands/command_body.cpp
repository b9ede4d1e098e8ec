// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/commands/command_body.h"

#include <nlohmann/json.hpp>
#include <string>

#include "app/model/json.h"

namespace orbwatch::app::web {
namespace {

/// Form of a body: {"view": 0 to 65535, "yaw": ...}.
std::string form(const CommandInfo& info) {
  std::string text = "{";
  for (std::size_t i = 0; i < info.argument_count(); ++i) {
    text += (i == 0 ? "\"" : ", \"") + std::string(info.arguments[i].name) +
            "\": " + range_text(info.arguments[i]);
  }
  return text + "}";
}

}  // namespace

Result<Command> parse_command(const CommandInfo& info, std::string_view body) {
  const auto sent = nlohmann::json::parse(body.empty() ? "{}" : body, nullptr, false);
  const std::size_t count = info.argument_count();
  if (!sent.is_object()) return fail("the body is not a JSON object; it must be " + form(info));
  if (sent.size() != count) {
    return fail("the body has " + std::to_string(sent.size()) + " members; it must be " +
                form(info));
  }
  Command command{info.code, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name(info.arguments[i].name);
    const auto value = sent.find(name);
    if (value == sent.end() || !value->is_number()) {
      return fail(name + " must be a number; the body must be " + form(info));
    }
    command.arguments[i] = value->get<double>();
  }
  if (check(command) != CommandResult::Done) return fail(refusal_text(command));
  return command;
}

std::string arguments_text(const CommandInfo& info, const Command& command) {
  nlohmann::ordered_json arguments;
  for (std::size_t i = 0; i < info.argument_count(); ++i) {
    arguments[std::string(info.arguments[i].name)] = to_json(command.arguments[i]);
  }
  return arguments.empty() ? "" : arguments.dump();
}

}  // namespace orbwatch::app::web
