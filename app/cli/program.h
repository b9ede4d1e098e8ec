// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/cli/cli_result.h"

namespace orbwatch::app::cli {

struct Arguments;

/// Body of main(): prints the result of `run` for the arguments, or its error after the program's
/// name, and returns the exit status.
int run_program(const char* name, const Arguments& arguments,
                CliResult<std::string> (*run)(const Arguments& arguments));

}  // namespace orbwatch::app::cli
