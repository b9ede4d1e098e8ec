// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/commands/command_body.h"

#include <string>

#include "app/model/status/json.h"
#include "app/ports/web/api/json_form.h"

namespace orbwatch::app::web {

Result<Command> parse_command(const CommandInfo& info, std::string_view body) {
  const auto sent = parse_body(body, schema_of(info));
  if (!sent) return tl::unexpected(sent.error());
  Command command{info.code, {}};
  for (std::size_t i = 0; i < info.argument_count(); ++i) {
    command.arguments[i] = sent->at(std::string(info.arguments[i].name)).get<double>();
  }
  if (check(command) != CommandResult::Done) return fail(refusal_text(command));
  return command;
}

std::string arguments_text(const CommandInfo& info, const Command& command) {
  Json arguments;
  for (std::size_t i = 0; i < info.argument_count(); ++i) {
    arguments[std::string(info.arguments[i].name)] = to_json(command.arguments[i]);
  }
  return arguments.empty() ? "" : arguments.dump();
}

}  // namespace orbwatch::app::web
