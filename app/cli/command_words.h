// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/model/command/command.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// Parses a command from its name and its arguments, in the units of kCommands. Errors: unknown
/// command, wrong number of arguments, not a number, out of range. Reentrant.
Result<Command> parse_command(const std::vector<std::string>& words);

/// All commands with their arguments, for --help. Reentrant.
std::string commands_help();

}  // namespace orbwatch::app::cli
