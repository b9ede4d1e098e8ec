// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace orbwatch::app {

/// Time since power-on from which the rate of writes means something: starting up reads and writes
/// more than a day of work at the same rate would.
inline constexpr double kShortestUptime = 600;  // s

/// Writes of all programs to the disk that has `folder`, in MiB per day, at the rate since
/// power-on. The disk is the whole card, of which partitions are worn together. signals::kNotValid:
/// the file system is on no block device of its own (tmpfs, overlayfs, btrfs), or the board runs
/// for less than kShortestUptime. `sys` and `proc` are the mount points of sysfs and procfs.
/// Reentrant.
double disk_written_per_day(const std::filesystem::path& sys, const std::filesystem::path& proc,
                            const std::filesystem::path& folder);

}  // namespace orbwatch::app
