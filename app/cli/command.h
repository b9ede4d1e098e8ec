// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// A command of `orbwatch`, or a subject of `orbwatch describe`.
struct Subcommand {
  std::string_view name;
  std::string_view text;  ///< description for --help
  /// `arguments` begin with its name. Returns the text for standard output.
  Result<std::string> (*run)(const std::vector<std::string>& arguments);
};

/// All commands of `orbwatch`.
std::span<const Subcommand> all_commands();

/// Lines of --help, one for each.
std::string subcommands_help(std::span<const Subcommand> subcommands);

Result<std::string> project_command(const std::vector<std::string>& arguments);
Result<std::string> advise_command(const std::vector<std::string>& arguments);
Result<std::string> detect_command(const std::vector<std::string>& arguments);
Result<std::string> register_command(const std::vector<std::string>& arguments);
Result<std::string> drift_command(const std::vector<std::string>& arguments);
Result<std::string> place_command(const std::vector<std::string>& arguments);
Result<std::string> setup_command(const std::vector<std::string>& arguments);
Result<std::string> calibration_command(const std::vector<std::string>& arguments);
Result<std::string> describe_command(const std::vector<std::string>& arguments);
Result<std::string> subscribe_command(const std::vector<std::string>& arguments);
Result<std::string> state_command(const std::vector<std::string>& arguments);
Result<std::string> command_command(const std::vector<std::string>& arguments);
Result<std::string> dds_keys_command(const std::vector<std::string>& arguments);
Result<std::string> bench_command(const std::vector<std::string>& arguments);
Result<std::string> configure_command(const std::vector<std::string>& arguments);
Result<std::string> doctor_command(const std::vector<std::string>& arguments);
Result<std::string> lines_command(const std::vector<std::string>& arguments);
Result<std::string> password_command(const std::vector<std::string>& arguments);
Result<std::string> list_command(const std::vector<std::string>& arguments);

// Subjects of describe_command; they write no file except that of -o.
Result<std::string> describe_view(const std::vector<std::string>& arguments);
Result<std::string> describe_camera(const std::vector<std::string>& arguments);

/// Becomes true at SIGINT (Ctrl-C) or SIGTERM, which do not terminate the process from the first
/// call on.
const std::atomic<bool>& cancelled_by_signal();

}  // namespace orbwatch::app
