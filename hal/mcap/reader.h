// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "hal/mcap/attachment.h"
#include "hal/mcap/chunk_loader.h"
#include "hal/mcap/file.h"
#include "hal/mcap/limits.h"
#include "hal/mcap/summary.h"

namespace orbwatch::hal::mcap {

/// Reads a recording of any origin, finished or not: of an unfinished one all complete chunks, as a
/// file that is being written or whose writer ended early. Everything that is read has been
/// checked; whatever a file holds, at most most_memory() is allocated. Messages must be in chunks,
/// compressed by zstd or not at all. Thread-bound.
class Reader {
 public:
  /// Reads the summary of a finished file and the whole of another. Errors: missing or unreadable,
  /// not an MCAP file, damaged, beyond the limits.
  static FileResult<Reader> open(const std::filesystem::path& path, const Limits& limits = {});
  static FileResult<Reader> open(File file, const Limits& limits = {});
  /// Reads the summary of a finished file, and never its records instead. Error also: the summary
  /// is missing, or its CRC is wrong.
  static FileResult<Reader> open_finished(const std::filesystem::path& path,
                                          const Limits& limits = {});

  const Header& header() const { return header_; }
  const Summary& summary() const { return summary_; }
  /// False: the file has no summary of its own, or one whose CRC is wrong.
  bool is_finished() const { return is_finished_; }

  /// Loads a chunk of summary().chunks for next(). Errors: damaged, or an unknown channel.
  FileResult<> load_chunk(std::size_t number);
  /// Next message of the loaded chunk, in the order of the file, valid until another chunk is
  /// loaded; nullopt behind the last one.
  std::optional<Message> next();

  /// Reads an attachment of summary().attachments. Error: damaged.
  FileResult<Attachment> attachment(std::size_t number);
  /// Reads the metadata of an entry of summary().metadata. Error: damaged.
  FileResult<Metadata> metadata(std::size_t number);

 private:
  Reader(File file, const Limits& limits) : file_(std::move(file)), limits_(limits) {}
  FileResult<bool> read_by_footer();
  FileResult<> check_chunk() const;

  File file_;
  Limits limits_;
  Header header_;
  Summary summary_;
  bool is_finished_ = false;
  Bytes stored_;  ///< the loaded record
  ChunkLoader loader_;
  std::span<const std::byte> rest_;  ///< unread records of the loaded chunk
};

}  // namespace orbwatch::hal::mcap
