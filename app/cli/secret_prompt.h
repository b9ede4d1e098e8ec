// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// Asks "WHAT: " on the terminal of standard input and returns the line, which is not shown.
/// Errors: standard input is not a terminal that can be kept from showing it; cancelled by Ctrl-C
/// or the end of input. Thread-bound.
Result<std::string> ask_secret(const std::string& what);

/// Asks twice. Error: also, the two differ.
Result<std::string> ask_new_secret(const std::string& what);

}  // namespace orbwatch::app::cli
