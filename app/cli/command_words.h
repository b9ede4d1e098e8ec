#pragma once

#include <string>
#include <vector>

#include "app/commands.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// A command out of its name and its arguments, in the units of kCommands. Errors: no such command,
/// not its number of arguments, no number, out of range. Reentrant.
Result<Command> parse_command(const std::vector<std::string>& words);

/// Every command with its arguments, for --help. Reentrant.
std::string commands_help();

}  // namespace orbwatch::app
