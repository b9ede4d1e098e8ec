// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "proc/image/result.h"

/// Headers of the entries in an archive of the format ustar (POSIX.1-1988); a file of 8 GiB or more
/// has its size as GNU tar writes it. All reentrant.
namespace orbwatch::app::cli {

/// Archives consist of blocks of this size, bytes.
inline constexpr std::size_t kTarBlock = 512;

/// A regular file in an archive.
struct TarEntry {
  std::string name;  ///< see check_archived_name()
  std::uint64_t size = 0;
  mode_t mode = 0600;
};

/// The block before the bytes of a file of owner 0. Errors: a name that is not right, or a name or
/// a size that does not fit into the format.
Result<std::string> tar_header(const TarEntry& entry, std::chrono::sys_seconds made);

/// Reads a block of any origin; owners and times are ignored. Errors: damaged; not a regular file,
/// such as a link or a device; a name that is not right.
Result<TarEntry> parse_tar_header(std::string_view block);

/// Bytes with those that fill the last block.
constexpr std::uint64_t tar_padded(std::uint64_t size) {
  return (size + kTarBlock - 1) / kTarBlock * kTarBlock;
}

}  // namespace orbwatch::app::cli
