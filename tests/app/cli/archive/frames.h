// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "app/cli/archive/frame_stream.h"

namespace orbwatch::app::cli {

/// Frames in memory, read in pieces of at most `piece` bytes.
inline FrameReader frames_of(const std::string& bytes, std::size_t piece = 1000) {
  const auto at = std::make_shared<std::size_t>(0);
  return FrameReader([bytes, at, piece](std::span<char> part) -> Result<std::size_t> {
    const std::size_t count = std::min({part.size(), piece, bytes.size() - *at});
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(*at), count, part.begin());
    *at += count;
    return count;
  });
}

/// The content of bytes that must be one frame.
inline Result<std::string> decompressed(const std::string& bytes, std::size_t most) {
  FrameReader frames = frames_of(bytes);
  const auto begun = frames.next();
  if (!begun) return tl::unexpected(begun.error());
  if (!*begun) return fail("is empty");
  return frames.read_all(most).and_then([&](std::string content) -> Result<std::string> {
    const auto more = frames.next();
    if (!more) return tl::unexpected(more.error());
    if (*more) return fail("other bytes follow");
    return content;
  });
}

}  // namespace orbwatch::app::cli
