// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

#include "hal/clock.h"
#include "hal/thread/thread.h"
#include "proc/image/result.h"

namespace orbwatch::app {
struct RecorderSettings;
}

namespace orbwatch::app::daemon {

/// Makes a folder of this user alone, unless it is there. Error: the disk.
Result<> make_owners_folder(const std::filesystem::path& folder);

/// Adds bytes to an uploaded file, which only its owner can read; at offset 0 a new one begins.
/// Returns its size. Errors: another offset than its size, the disk; the file is then as before.
/// Not for two threads with the same file.
Result<std::uint64_t> add_uploaded(const std::filesystem::path& file, std::uint64_t offset,
                                   std::string_view bytes);

/// Text such as "64 MiB". Reentrant.
std::string mebibytes(std::uint64_t bytes);

/// Free space that a large backup leaves on the disk, bytes: the recorder's reserve;
/// BackupUpload::kSmall if nothing is recorded. Reentrant.
std::uint64_t backup_reserve(const RecorderSettings& recorder);

/// A backup that is uploaded in parts. It is removed when it is not used for a while. Thread-safe.
class BackupUpload {
 public:
  /// Largest upload: a backup with kept events.
  static constexpr std::uint64_t kMost = std::uint64_t{2} << 30;
  /// Larger uploads leave the reserve free.
  static constexpr std::uint64_t kSmall = std::uint64_t{64} << 20;
  /// Time to find out the addresses of other cameras; longer than a restore takes.
  static constexpr std::chrono::minutes kLongestPause{30};

  /// `reserve` is the free space that stays on the disk of `file`, bytes.
  BackupUpload(std::filesystem::path file, std::uint64_t reserve,
               hal::Clock::duration longest_pause = kLongestPause);

  const std::filesystem::path& file() const { return file_; }

  /// See add_uploaded(). Further errors: larger than kMost; no room.
  Result<std::uint64_t> add(std::uint64_t offset, std::string_view bytes);

  /// The pause begins anew: the file is used.
  void keep();

 private:
  Result<> check_room(std::uint64_t offset, std::uint64_t bytes) const;
  void keep_locked();
  void run();

  const std::filesystem::path file_;
  const std::uint64_t reserve_;
  const hal::Clock::duration longest_pause_;
  std::mutex mutex_;                                  ///< of abandoned_ and the file
  hal::TimePoint abandoned_ = hal::TimePoint::max();  ///< when the file counts as abandoned
  hal::Thread thread_;
};

}  // namespace orbwatch::app::daemon
