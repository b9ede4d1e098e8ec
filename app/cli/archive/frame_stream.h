// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "proc/image/result.h"

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

/// Frames of Zstandard (RFC 8878), one after another, of any length. Thread-bound.
namespace orbwatch::app::cli {

/// Writes one frame with a checksum; for bytes that are compressed already.
class FrameWriter {
 public:
  using Sink = std::function<Result<>(std::string_view bytes)>;

  explicit FrameWriter(Sink sink);

  /// Errors: of the sink; out of memory.
  Result<> add(std::string_view bytes);
  /// Ends the frame. Errors: as of add().
  Result<> finish();

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
  };

  Result<> write(std::string_view bytes, bool is_last);

  Sink sink_;
  std::unique_ptr<ZSTD_CCtx_s, Free> context_;
  std::string buffer_;
};

/// Reads bytes of any origin.
class FrameReader {
 public:
  /// Reads up to as many bytes; 0: there are no more.
  using Source = std::function<Result<std::size_t>(std::span<char> bytes)>;

  explicit FrameReader(Source source);

  /// Begins the next frame; false: there is none. The frame before must have been read to its end.
  Result<bool> next();
  /// Reads the next bytes of the frame; fewer than asked for only at its end. Errors: of the
  /// source; damaged or cut off; a frame that needs more than 16 MiB of memory.
  Result<std::size_t> read(std::span<char> bytes);
  /// Reads the rest of the frame. Error also: it is larger than `most`.
  Result<std::string> read_all(std::size_t most);

 private:
  struct Free {
    void operator()(ZSTD_DCtx_s* context) const;
  };

  Result<bool> refill();

  Source source_;
  std::unique_ptr<ZSTD_DCtx_s, Free> context_;
  std::string buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< bytes in the buffer that are not decompressed yet
  bool is_in_frame_ = false;
};

}  // namespace orbwatch::app::cli
