// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "app/model/command/command.h"
#include "proc/image/result.h"

namespace orbwatch::app::web {

/// Parses a command from the body of its request: a JSON object with each argument by its name, in
/// its unit; an empty body means no arguments. Errors: not such an object; an argument is missing,
/// unknown, not a number or out of range. Reentrant.
Result<Command> parse_command(const CommandInfo& info, std::string_view body);

/// Body that parse_command() accepts: {"view":0,"yaw":12.5}; empty without arguments. Reentrant.
std::string arguments_text(const CommandInfo& info, const Command& command);

}  // namespace orbwatch::app::web
