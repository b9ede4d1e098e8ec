// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/commands/command_desk.h"

#include "app/ports/web/api/record_schema.h"
#include "app/ports/web/commands/command_body.h"

namespace orbwatch::app::web {
namespace {

/// Origin of a command of another interface. All PLCs share one client; the number of another
/// client is its own choice.
std::string interface_of(const UnauditedCommand& given) {
  std::string interface(given.command.giver.name());
  if (given.id.client != kPlcClient) interface += ", client " + std::to_string(given.id.client);
  return interface;
}

/// The code of an unknown command is a value: as the action it would be a text of the client's.
Audit::Entry audit_entry_of(const UnauditedCommand& given) {
  const CommandInfo* info = find_command(given.command.code);
  return {given.time,
          "",
          interface_of(given),
          info ? std::string(info->name) : "unknown command",
          "",
          info ? arguments_text(*info, given.command)
               : std::to_string(static_cast<std::uint16_t>(given.command.code)),
          std::string(operator_text(given.result))};
}

}  // namespace

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

void CommandDesk::note_others() {
  while (const auto given = record_->take_unaudited()) {
    audit_.note_command(audit_entry_of(*given), std::string(given->command.giver.name()));
  }
  note_lost();
}

void CommandDesk::note_lost() {
  const std::uint64_t lost = record_->lost_unaudited();
  if (lost == noted_lost_) return;
  audit_.note_command(
      {std::chrono::system_clock::now(), "", "", "unrecorded commands", std::to_string(noted_lost_),
       std::to_string(lost), "too many commands at a time"},
      "");
  noted_lost_ = lost;
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
