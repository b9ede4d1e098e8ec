// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zstd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "hal/mcap/fields.h"
#include "hal/mcap/file_result.h"

namespace orbwatch::hal::mcap {

/// Name of zstd in chunks.
inline constexpr const char* kZstd = "zstd";

struct ZstdFree {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

/// Compresses into a buffer that is kept, and grows with the largest input: a chunk may be large,
/// but those of a log are small. Thread-bound.
class ZstdEncoder {
 public:
  /// `level` of zstd, 1 is fast.
  explicit ZstdEncoder(int level) : context_(ZSTD_createCCtx()), level_(level) {}

  /// Compressed bytes, valid until the next call. Error: out of memory.
  FileResult<std::span<const std::byte>> encode(std::span<const std::byte> bytes) {
    buffer_.resize(std::max(buffer_.size(), ZSTD_compressBound(bytes.size())));
    const std::size_t size = context_
                                 ? ZSTD_compressCCtx(context_.get(), buffer_.data(), buffer_.size(),
                                                     bytes.data(), bytes.size(), level_)
                                 : 0;
    if (size == 0 || ZSTD_isError(size) != 0) return failed(ENOMEM, "zstd");
    return std::span<const std::byte>(buffer_).first(size);
  }

 private:
  std::unique_ptr<ZSTD_CCtx, ZstdFree> context_;
  Bytes buffer_;
  int level_;
};

/// Decompresses bytes of any origin. Thread-bound.
class ZstdDecoder {
 public:
  ZstdDecoder() : context_(ZSTD_createDCtx()) {}

  /// Error unless `bytes` say no other size than that of a buffer of `size` bytes.
  static FileResult<> check_size(std::span<const std::byte> bytes, std::uint64_t size) {
    const unsigned long long said = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (said == ZSTD_CONTENTSIZE_ERROR) return refuse("not zstd data");
    if (said == ZSTD_CONTENTSIZE_UNKNOWN || said == size) return {};
    return refuse("zstd data of " + std::to_string(said) + " bytes in a chunk of " +
                  std::to_string(size) + " bytes");
  }

  /// Fills `into`; never writes more. Error: damaged, or another size.
  FileResult<> decode(std::span<const std::byte> bytes, std::span<std::byte> into) {
    if (!context_) return failed(ENOMEM, "zstd");
    const std::size_t size =
        ZSTD_decompressDCtx(context_.get(), into.data(), into.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size) != 0) return refuse(std::string("zstd: ") + ZSTD_getErrorName(size));
    if (size == into.size()) return {};
    return refuse("zstd data of " + std::to_string(size) + " bytes in a chunk of " +
                  std::to_string(into.size()) + " bytes");
  }

 private:
  std::unique_ptr<ZSTD_DCtx, ZstdFree> context_;
};

}  // namespace orbwatch::hal::mcap
