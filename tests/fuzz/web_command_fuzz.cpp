// SPDX-License-Identifier: Apache-2.0
#include <strings.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "app/ports/web/access/access_records.h"
#include "app/ports/web/access/users.h"
#include "app/ports/web/api/record_schema.h"
#include "app/ports/web/commands/command_body.h"
#include "app/ports/web/http/address.h"
#include "app/ports/web/machine/machine_desk.h"

namespace {

orbwatch::Result<> take_state(const orbwatch::app::MachineState& state) {
  return orbwatch::app::check(state);
}

}  // namespace

/// Any bytes as the body of a command or of a machine's state over HTTP, as that of a user, as a
/// users file and as a Host header: the first byte selects the command. An accepted command must be
/// an allowed one of that name, a refusal must have a reason, and only numbers and localhost are
/// names of this host.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orbwatch::app;
  if (size == 0) return 0;
  const CommandInfo& info = kCommands[data[0] % kCommands.size()];
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto command = web::parse_command(info, text);
  if (command && (command->code != info.code || check(*command) != CommandResult::Done)) {
    std::abort();
  }
  if (!command && command.error().message.empty()) std::abort();
  auto user = web::parse_record<web::UserBody>(text);
  if (user && !web::parse_record<web::UserBody>(web::json_text(web::json_of(*user)))) std::abort();
  if (!user && user.error().message.empty()) std::abort();
  const auto users = web::parse_users(text);
  if (users && !web::parse_users(web::users_text(*users))) std::abort();
  const bool is_number =
      text.find_first_not_of("0123456789abcdefABCDEF.:[]") == std::string_view::npos;
  const bool is_localhost = text.size() >= 9 && ::strncasecmp(text.data(), "localhost", 9) == 0 &&
                            (text.size() == 9 || text[9] == ':');
  if (web::is_own_host(text, {}) && !is_number && !is_localhost) std::abort();
  const web::MachineDesk desk({MachineSource::Http, take_state});
  web::Request state;
  state.body = text;
  const int status = desk.take(state).status;
  if (status != 200 && status != 400) std::abort();
  return 0;
}
