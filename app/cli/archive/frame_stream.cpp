// SPDX-License-Identifier: Apache-2.0
#include "app/cli/archive/frame_stream.h"

#include <zstd.h>

#include <algorithm>
#include <utility>

namespace orbwatch::app::cli {
namespace {

constexpr int kFast = 1;
constexpr int kLargestWindow = 24;  ///< logarithm of its bytes
constexpr std::size_t kBuffer = std::size_t{128} << 10;

}  // namespace

void FrameWriter::Free::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }
void FrameReader::Free::operator()(ZSTD_DCtx_s* context) const { ZSTD_freeDCtx(context); }

FrameWriter::FrameWriter(Sink sink)
    : sink_(std::move(sink)), context_(ZSTD_createCCtx()), buffer_(kBuffer, '\0') {
  if (!context_) return;
  ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, kFast);
  ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_checksumFlag, 1);
}

Result<> FrameWriter::add(std::string_view bytes) { return write(bytes, false); }
Result<> FrameWriter::finish() { return write({}, true); }

Result<> FrameWriter::write(std::string_view bytes, bool is_last) {
  if (!context_) return fail("zstd: out of memory");
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  const auto mode = is_last ? ZSTD_e_end : ZSTD_e_continue;
  for (std::size_t left = 1; left > 0;) {
    ZSTD_outBuffer out{buffer_.data(), buffer_.size(), 0};
    left = ZSTD_compressStream2(context_.get(), &out, &in, mode);
    if (ZSTD_isError(left) != 0) return fail(std::string("zstd: ") + ZSTD_getErrorName(left));
    auto written = sink_(std::string_view(buffer_).substr(0, out.pos));
    if (!written) return written;
    if (!is_last && in.pos == in.size) break;
  }
  return {};
}

FrameReader::FrameReader(Source source)
    : source_(std::move(source)), context_(ZSTD_createDCtx()), buffer_(kBuffer, '\0') {
  if (context_) ZSTD_DCtx_setParameter(context_.get(), ZSTD_d_windowLogMax, kLargestWindow);
}

/// False: the source has no more.
Result<bool> FrameReader::refill() {
  if (begin_ < end_) return true;
  const auto count = source_(buffer_);
  if (!count) return tl::unexpected(count.error());
  begin_ = 0;
  end_ = *count;
  return end_ > 0;
}

Result<bool> FrameReader::next() {
  if (!context_) return fail("zstd: out of memory");
  if (is_in_frame_) return fail("has bytes after its end");
  auto more = refill();
  is_in_frame_ = more.value_or(false);
  return more;
}

Result<std::size_t> FrameReader::read(std::span<char> bytes) {
  ZSTD_outBuffer out{bytes.data(), bytes.size(), 0};
  while (is_in_frame_ && out.pos < out.size) {
    ZSTD_inBuffer in{buffer_.data(), end_, begin_};
    const std::size_t before = out.pos;
    const std::size_t left = ZSTD_decompressStream(context_.get(), &out, &in);
    if (ZSTD_isError(left) != 0) {
      return fail(std::string("is damaged, or not compressed by zstd: ") + ZSTD_getErrorName(left));
    }
    begin_ = in.pos;
    is_in_frame_ = left > 0;
    if (!is_in_frame_ || out.pos > before) continue;
    const auto more = refill();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return fail("is cut off");
  }
  return out.pos;
}

Result<std::string> FrameReader::read_all(std::size_t most) {
  std::string all;
  std::string part(kBuffer, '\0');
  while (true) {
    const auto count = read(part);
    if (!count) return tl::unexpected(count.error());
    if (*count > most - all.size()) {
      return fail("is larger than " + std::to_string(most >> 20) + " MiB");
    }
    all.append(part, 0, *count);
    if (*count < part.size()) return all;
  }
}

}  // namespace orbwatch::app::cli
