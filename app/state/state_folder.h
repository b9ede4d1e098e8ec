// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

/// Folder for state that survives restarts of the orbwatchd of a configuration file. Several
/// machines on one board have a folder each, which records its configuration file.
namespace orbwatch::app {

/// File of a state folder with the files of a restore that are put in place before orbwatchd starts
/// the next time.
inline constexpr const char* kPendingRestore = "restore-pending.tar";

/// First folder of systemd's STATE_DIRECTORY (systemd.exec(5)); nullopt: not set or empty. Not
/// while the environment is changed.
std::optional<std::filesystem::path> state_directory();

/// First folder of systemd's RUNTIME_DIRECTORY, which is empty after the board's start and usable
/// when the disk is full; nullopt: not set or empty. Not while the environment is changed.
std::optional<std::filesystem::path> runtime_directory();

/// systemd's unit that runs the configuration file `configuration`, see platform/service:
/// orbwatch@NAME for /etc/orbwatch/NAME/site.toml, orbwatch for any other file. Reentrant.
std::string unit_of(const std::filesystem::path& configuration);

/// State folder of the configuration file `configuration`, the same for orbwatchd and for programs:
/// 1. `configured`, unless it is empty;
/// 2. state_directory();
/// 3. the folder orbwatch or orbwatch-* below `lib` that records this configuration file;
/// 4. orbwatch-NAME below `lib` for /etc/orbwatch/NAME/site.toml, orbwatch for any other file.
/// Error: 2 or 4 records another configuration file or cannot be read by this user, or several
/// folders record this one; the message states what to set. Not while the environment is changed.
Result<std::filesystem::path> state_folder(const std::filesystem::path& configured,
                                           const std::filesystem::path& configuration,
                                           const std::filesystem::path& lib = "/var/lib");

/// Reserves `folder`, which is created, for this process until the descriptor is closed: two
/// orbwatchd would use each other's trials and records. Not open: the folder cannot be written.
/// Error: another process has reserved it. Reentrant.
Result<hal::FileDescriptor> reserve(const std::filesystem::path& folder);

/// The configuration file that a state folder records; nullopt: none, or not readable. Reentrant.
std::optional<std::filesystem::path> owner_of(const std::filesystem::path& folder);

/// Records `configuration` as the owner of `folder`, which is created. Returns the other
/// configuration file that was recorded before, if any. Error: as hal::write_file(). Reentrant.
Result<std::optional<std::filesystem::path>> record_owner(
    const std::filesystem::path& folder, const std::filesystem::path& configuration);

}  // namespace orbwatch::app
