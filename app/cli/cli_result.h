// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "app/exit_status.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// Reason why a command does not do what was asked, with its exit status. Any other error is a
/// failure.
struct CliError {
  // NOLINTNEXTLINE(google-explicit-constructor): an error of another room
  CliError(Error error) : message(std::move(error.message)) {}
  CliError(std::string text, ExitStatus ends_with) : message(std::move(text)), status(ends_with) {}

  std::string message;
  ExitStatus status = ExitStatus::Failed;
};

/// Result of a command, or of a step that may refuse its options.
template <class T = void>
using CliResult = tl::expected<T, CliError>;

/// Error of a command whose options or arguments are wrong: `what`, and a reference to the help.
inline tl::unexpected<CliError> usage_error(const std::string& what) {
  return tl::unexpected(CliError(what + "; see --help", ExitStatus::WrongUsage));
}

}  // namespace orbwatch::app::cli
