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

/// The processes of a program, by its name in the kernel. `proc` is the mount point of procfs.
std::vector<std::filesystem::path> processes_of(const std::filesystem::path& proc,
                                                std::string_view name);

/// The program that listens on a TCP port, if this user may see it; else empty.
std::string listener_on(const std::filesystem::path& proc, int port);

/// A time in systemd's notation ("1min 30s", "infinity", "0"), s; nullopt: not a time.
std::optional<double> parse_time_span(std::string_view text);

}  // namespace orbwatch::app::cli::doctor
