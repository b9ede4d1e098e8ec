// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/cli/doctor/facts.h"
#include "app/cli/doctor/sources.h"

namespace orbwatch::app::cli::doctor {

/// Reads all facts for the configuration `file`. Changes nothing, disturbs no stream, keeps no
/// port. Unreadable facts remain unknown, whatever the files contain. Waits for programs, 5 s each
/// at most, and for drivers. Must not be called while the environment is changed.
Facts gather(const Sources& sources, const std::filesystem::path& file);

// Parts of gather(), one file each.
void gather_kernel(const Sources& sources, Facts& facts);
void gather_devices(const Sources& sources, Facts& facts);
void gather_limits(const Sources& sources, Facts& facts);
void gather_network(const Sources& sources, Facts& facts);

/// Beginning of the environment's entry with the configuration file.
inline constexpr std::string_view kConfigVariable = "ORBWATCH_CONFIG=";

/// The processes of a program, by its name in the kernel. `proc` is the mount point of procfs.
std::vector<std::filesystem::path> processes_of(const std::filesystem::path& proc,
                                                std::string_view name);

struct Listener {
  std::string name;               ///< of the program, in the kernel
  std::filesystem::path process;  ///< its folder in procfs
};

/// The program that listens on a TCP port, if this user may see it; else nullopt.
std::optional<Listener> listener_on(const std::filesystem::path& proc, int port);

/// The configuration file of an orbwatchd, by its arguments and environment as files::site_file();
/// nullopt: this user may not read them.
std::optional<std::filesystem::path> configuration_of(const std::filesystem::path& process);

/// True for two paths of one file, also by a symbolic link.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// A time in systemd's notation ("1min 30s", "infinity", "0"), s; nullopt: not a time.
std::optional<double> parse_time_span(std::string_view text);

}  // namespace orbwatch::app::cli::doctor
