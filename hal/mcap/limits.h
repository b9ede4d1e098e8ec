// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace orbwatch::hal::mcap {

inline constexpr std::size_t kMebibyte = std::size_t{1} << 20;

/// Bounds in bytes, of what a Writer writes and of what is accepted from a file of any origin.
struct Limits {
  std::size_t chunk = 64 * kMebibyte;       ///< records of a chunk, uncompressed
  std::size_t attachment = 16 * kMebibyte;  ///< any other record of the data section
  std::size_t summary = 32 * kMebibyte;     ///< summary section: about an hour of 30 chunks/s
};

inline constexpr std::size_t kMostName = 1024;  ///< bytes of a topic or another name
inline constexpr std::size_t kMostMapEntries =
    64;  ///< entries in the metadata of a channel or a file

/// Most bytes of a stored chunk: what zstd makes of data that cannot be compressed.
constexpr std::size_t most_stored(const Limits& limits) {
  return limits.chunk + limits.chunk / 128 + kMebibyte;
}

/// Most memory that reading or completing a file allocates, whatever the file holds: a chunk as
/// stored, uncompressed and with the index of the shortest possible messages; an attachment twice;
/// the summary and the six times of it that its parts take at most.
constexpr std::size_t most_memory(const Limits& limits) {
  return most_stored(limits) + 3 * limits.chunk + 2 * limits.attachment + 7 * limits.summary;
}

}  // namespace orbwatch::hal::mcap
