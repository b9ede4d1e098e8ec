#pragma once

#include <span>
#include <string>

#include "app/cli/command.h"

namespace orbwatch::app {

/// Manual page of `orbwatch` in man(7)'s language, from what its commands declare. Subjects are
/// those of `orbwatch describe`.
std::string man_page(std::span<const Subcommand> commands, std::span<const Subcommand> subjects);

/// Completion of its command line by bash(1).
std::string bash_completion(std::span<const Subcommand> commands,
                            std::span<const Subcommand> subjects);

}  // namespace orbwatch::app
