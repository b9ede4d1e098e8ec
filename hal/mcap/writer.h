// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "hal/mcap/attachment.h"
#include "hal/mcap/chunk_builder.h"
#include "hal/mcap/file.h"
#include "hal/mcap/limits.h"
#include "hal/mcap/summary.h"
#include "hal/mcap/zstd_codec.h"

namespace orbwatch::hal::mcap {

struct WriterSettings {
  Header header{};                     ///< profile and name of the writer
  std::size_t chunk = 32 * kMebibyte;  ///< most bytes between two calls of flush()
  bool is_compressed = true;           ///< by zstd; not worth its time for JPEG alone
  int level = 1;                       ///< compression level of zstd
};

/// Writes a recording. Messages gather in a chunk in memory; flush() writes it with a single
/// record, so that the file holds all messages of a chunk or none, wherever the power is cut:
/// complete() finishes such a file, and any reader of MCAP reads it before that up to the torn
/// record.
///
/// An error of flush(), such as ENOSPC, EROFS or EIO of the disk, costs the messages since the last
/// one, and an error of attach() the attachment; the file keeps its earlier content and writing may
/// go on. Thread-bound; not for the frame path, since it allocates.
class Writer {
 public:
  /// Makes a new file. Errors: there is one; the folder is not writable; settings.chunk is 0 or
  /// beyond Limits (EINVAL).
  static FileResult<Writer> create(const std::filesystem::path& path,
                                   const WriterSettings& settings = {});

  /// Defines the schema of messages; returns its id. Error: a name that a Reader refuses.
  FileResult<std::uint16_t> add_schema(Schema schema);
  /// Defines a topic; returns its id. Errors: a name that a Reader refuses, an unknown schema.
  FileResult<std::uint16_t> add_channel(Channel channel);

  /// Adds a message to the chunk. Errors: an unknown channel (EINVAL); the chunk has no room for it
  /// (EMSGSIZE): flush() makes room.
  FileResult<> write(const MessageHead& head, std::span<const std::byte> data);

  /// Writes the chunk, if there is a message. Error: the disk; the summary is full (EFBIG): finish
  /// and begin another file.
  FileResult<> flush();
  /// Makes what was flushed survive a power cut.
  FileResult<> sync() const { return file_.sync(); }

  /// Writes a file into the recording. Errors: the disk; a name that a Reader refuses; too large.
  FileResult<> attach(const Attachment& attachment);
  /// Writes pairs of texts under a name. Errors as of attach().
  FileResult<> add_metadata(const Metadata& metadata);

  /// Writes the chunk, the summary and the end of the file; nothing may be written after it. After
  /// an error the file remains unfinished, and finish() can be tried again.
  FileResult<> finish();

  /// Bytes in the file, without its end.
  std::uint64_t size() const { return end_; }

 private:
  Writer(File file, const WriterSettings& settings);

  FileResult<> append(std::initializer_list<std::span<const std::byte>> parts);
  FileResult<> check_summary(std::size_t more) const;
  Bytes definitions_of(const Channel& channel) const;
  FileResult<ChunkIndex> write_chunk();

  File file_;
  WriterSettings settings_;
  ChunkBuilder chunk_;
  ZstdEncoder zstd_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<std::uint16_t> new_channels_;  ///< defined in the chunk, not yet in the file
  std::size_t definition_bytes_ = 0;         ///< bytes of these and their schemas
  Summary summary_;                          ///< summary of the file so far
  std::size_t summary_bytes_ = 0;
  std::uint64_t end_ = 0;  ///< end of the data section
  std::uint32_t crc_ = 0;  ///< CRC of all bytes in front of end_
};

}  // namespace orbwatch::hal::mcap
