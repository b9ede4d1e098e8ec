// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/mjpeg_stream.h"

#include "app/model/status/utc_text.h"

namespace orbwatch::app::web {

namespace {

/// Sent after each picture, so that players show it without waiting for the next.
constexpr std::string_view kBoundary = "\r\n--orbwatch\r\n";

}  // namespace

bool MjpegStream::begin_next() {
  const std::uint64_t skipped = reader_->skipped();
  const auto next = reader_->next();
  if (!next) return false;
  counts_.skipped += reader_->skipped() - skipped;
  ++counts_.sent;
  const std::string_view before = picture_ ? "" : kBoundary;
  picture_ = next->bytes;
  head_ = std::string(before) +
          "Content-Type: image/jpeg\r\nContent-Length: " + std::to_string(picture_->size()) +
          "\r\nX-Timestamp: " + utc_text(hal::to_utc(next->stamp)).value_or("") + "\r\n\r\n";
  parts_.begin({head_, *picture_, kBoundary});
  return true;
}

std::size_t MjpegStream::read(std::span<char> out) {
  if (parts_.are_sent() && !begin_next()) return 0;
  // The next picture is chosen when the client has room for it, so that it is the newest.
  return parts_.read(out);
}

}  // namespace orbwatch::app::web
