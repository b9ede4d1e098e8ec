// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "app/cli/command.h"
#include "app/cli/options/options.h"

namespace orbwatch::app::cli {

/// Declaration that a command passes to run_command(), without running it; its options must not be
/// set. Nullopt: it takes no options.
std::optional<CommandLine> declaration_of(const Subcommand& command);

}  // namespace orbwatch::app::cli
