// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/content_coding.h"

#include <zlib.h>

#include <algorithm>
#include <new>

#include "app/ports/web/http/accepted_encoding.h"

namespace orbwatch::app::web {
namespace {

/// Level for an answer that is made for one client: zlib's compromise of time and size.
constexpr int kAnswerLevel = 6;

/// True: the coding was chosen for the client already.
bool is_chosen(const Response& response) {
  return std::ranges::any_of(response.headers,
                             [](const auto& header) { return header.first == "Vary"; });
}

}  // namespace

std::string gzip(std::string_view content, int level) {
  constexpr int kGzip = 16;  // added to the window's bits: header and end are those of gzip
  constexpr int kUsualMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, kGzip + MAX_WBITS, kUsualMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string packed(deflateBound(&stream, content.size()), '\0');
  // The C API takes a non-const pointer, but only reads.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);  // ends at once, because the bound has room for all
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

Response packed_for(const Request& request, Response response) {
  if (!response.body || response.type != kJson || response.body->size() < kLeastPacked ||
      is_chosen(response)) {
    return response;
  }
  response.headers.emplace_back("Vary", "Accept-Encoding");
  if (!accepts_gzip(request)) return response;
  response.headers.emplace_back("Content-Encoding", "gzip");
  response.body = std::make_shared<const std::string>(gzip(*response.body, kAnswerLevel));
  return response;
}

}  // namespace orbwatch::app::web
