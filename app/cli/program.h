// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Body of main(): prints the result of `run` for the arguments, or its error after the program's
/// name, and returns the exit status.
int run_program(const char* name, const std::vector<std::string>& arguments,
                Result<std::string> (*run)(const std::vector<std::string>& arguments));

}  // namespace orbwatch::app
