// SPDX-License-Identifier: Apache-2.0
#include "app/cli/command.h"
#include "app/cli/command_words.h"
#include "app/cli/dds/command_client.h"
#include "app/cli/options/dds_options.h"
#include "app/cli/options/options.h"

namespace orbwatch::app::cli {

CliResult<std::string> command_command(const Arguments& arguments) {
  CommandOptions o;
  return run_command(
      arguments,
      {.usage = "Usage: orbwatch command [options] NAME [ARGUMENT...]\n\n"
                "Sends a command to a running orbwatchd over DDS and waits until it is carried "
                "out.\nOptions stand before NAME.\n\n",
       .options = {domain_option(o.domain), prefix_option(o.prefix), security_option(o.security),
                   timeout_option(o.timeout)},
       .takes_words = true,
       .order = OptionOrder::First,  // angles may be negative
       .notes = "\nCommands:\n" + commands_help()},
      [&](const std::vector<std::string>& words) -> CliResult<std::string> {
        const auto command = parse_command(words);
        if (!command) return usage_error(command.error().message);
        const auto answer = send_command(o, *command, cancelled_by_signal());
        if (!answer) return tl::unexpected(answer.error());
        if (answer->result != CommandResult::Done) return fail(words.front() + ": " + answer->text);
        return {};
      });
}

}  // namespace orbwatch::app::cli
