#pragma once

#include "app/cli/doctor/facts.h"
#include "app/cli/doctor/sources.h"

namespace orbwatch::app::doctor {

/// Reads all facts for the configuration `file`. Changes nothing, disturbs no stream, keeps no
/// port. What cannot be read is left unknown, whatever it contains. Waits for programs, 5 s each at
/// most, and for drivers. Not while the environment is changed.
Facts gather(const Sources& sources, const std::filesystem::path& file);

// Its parts, one file each.
void gather_kernel(const Sources& sources, Facts& facts);
void gather_devices(const Sources& sources, Facts& facts);
void gather_limits(const Sources& sources, Facts& facts);
void gather_network(const Sources& sources, Facts& facts);

/// The processes of a program, by what the kernel calls it. `proc`: where procfs is mounted.
std::vector<std::filesystem::path> processes_of(const std::filesystem::path& proc,
                                                std::string_view name);

/// The program that listens on a TCP port, as far as this user may see; else empty.
std::string listener_on(const std::filesystem::path& proc, int port);

/// A time as systemd prints it ("1min 30s", "infinity", "0"), s; nullopt: it is none.
std::optional<double> parse_time_span(std::string_view text);

}  // namespace orbwatch::app::doctor
