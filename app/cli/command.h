// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <span>
#include <string>
#include <string_view>

#include "app/cli/cli_result.h"

namespace orbwatch::app::cli {

struct Arguments;

/// A command of `orbwatch`, or a subject of `orbwatch describe`.
struct Subcommand {
  std::string_view name;
  std::string_view text;  ///< description for --help
  /// `arguments` begin with its name. Returns the text for standard output.
  CliResult<std::string> (*run)(const Arguments& arguments);
};

/// All commands of `orbwatch`.
std::span<const Subcommand> all_commands();

/// Lines of --help, one for each.
std::string subcommands_help(std::span<const Subcommand> subcommands);

CliResult<std::string> project_command(const Arguments& arguments);
CliResult<std::string> advise_command(const Arguments& arguments);
CliResult<std::string> detect_command(const Arguments& arguments);
CliResult<std::string> register_command(const Arguments& arguments);
CliResult<std::string> drift_command(const Arguments& arguments);
CliResult<std::string> replay_command(const Arguments& arguments);
CliResult<std::string> place_command(const Arguments& arguments);
CliResult<std::string> setup_command(const Arguments& arguments);
CliResult<std::string> calibration_command(const Arguments& arguments);
CliResult<std::string> describe_command(const Arguments& arguments);
CliResult<std::string> subscribe_command(const Arguments& arguments);
CliResult<std::string> state_command(const Arguments& arguments);
CliResult<std::string> command_command(const Arguments& arguments);
CliResult<std::string> dds_keys_command(const Arguments& arguments);
CliResult<std::string> bench_command(const Arguments& arguments);
CliResult<std::string> support_command(const Arguments& arguments);
CliResult<std::string> backup_command(const Arguments& arguments);
CliResult<std::string> restore_command(const Arguments& arguments);
CliResult<std::string> reset_command(const Arguments& arguments);
CliResult<std::string> configure_command(const Arguments& arguments);
CliResult<std::string> doctor_command(const Arguments& arguments);
CliResult<std::string> lines_command(const Arguments& arguments);
CliResult<std::string> password_command(const Arguments& arguments);
CliResult<std::string> events_command(const Arguments& arguments);
CliResult<std::string> update_command(const Arguments& arguments);
CliResult<std::string> list_command(const Arguments& arguments);

// Subjects of describe_command; they write no file except that of -o.
CliResult<std::string> describe_view(const Arguments& arguments);
CliResult<std::string> describe_camera(const Arguments& arguments);

/// Becomes true at SIGINT (Ctrl-C) or SIGTERM, which do not terminate the process from the first
/// call on.
const std::atomic<bool>& cancelled_by_signal();

}  // namespace orbwatch::app::cli
