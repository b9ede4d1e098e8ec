// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "app/cli/command.h"

namespace orbwatch::app::cli {

/// Manual page of `orbwatch` in the language of man(7), generated from the declarations of its
/// commands. Subjects are those of `orbwatch describe`.
std::string man_page(std::span<const Subcommand> commands, std::span<const Subcommand> subjects);

/// Completion of the command line of `orbwatch` for bash(1).
std::string bash_completion(std::span<const Subcommand> commands,
                            std::span<const Subcommand> subjects);

}  // namespace orbwatch::app::cli
