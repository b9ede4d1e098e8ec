// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/commands/command_desk.h"

#include "app/ports/web/api/record_schema.h"
#include "app/ports/web/commands/command_body.h"

namespace orbwatch::app::web {

void CommandDesk::run(const CommandInfo& info, const ExchangePtr& exchange) {
  const Request& request = exchange->request();
  auto command = parse_command(info, request.body);
  if (!command) {
    exchange->answer(error_response(400, command.error().message));
    return;
  }
  const auto before = views_.at_present(*command);
  const std::string who = access_.caller(credentials_of(request)).name;
  command->giver = Giver(who.empty() ? "over HTTP" : who);
  const Audit::Entry entry{{},
                           who,
                           client_address(request),
                           std::string(info.name),
                           before ? arguments_text(info, *before) : "",
                           arguments_text(info, *command),
                           {}};
  runner_.run(*command, exchange, [this, entry](CommandResult result) {
    Audit::Entry noted = entry;
    noted.time = std::chrono::system_clock::now();
    noted.result = operator_text(result);
    audit_.note(noted);
  });
}

Route command_route(const CommandInfo& info, CommandDesk* desk) {
  Route route{"POST", "/api/v1/command/" + std::string(info.name), info.role,
              std::string(info.description), std::string(kJson)};
  route.body = [&info] { return schema_of(info); };
  route.answer = schema_of<CommandAnswer, Sent::ByUs>;
  route.serve = [desk, &info](const ExchangePtr& exchange) { desk->run(info, exchange); };
  route.command = &info;
  return route;
}

}  // namespace orbwatch::app::web
