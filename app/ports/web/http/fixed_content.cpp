// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/fixed_content.h"

#include <zlib.h>

#include <memory>
#include <new>
#include <utility>

#include "app/ports/web/http/accepted_encoding.h"
#include "app/ports/web/http/entity_tag.h"

namespace orbwatch::app::web {

std::string gzip(std::string_view content) {
  constexpr int kGzip = 16;  // added to the window's bits: header and end are those of gzip
  constexpr int kUsualMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip + MAX_WBITS, kUsualMemory,
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

FixedContent::FixedContent(std::string_view type, std::string_view content, std::string_view packed)
    : content_(std::make_shared<const std::string>(content)),
      packed_(std::make_shared<const std::string>(packed)),
      type_(type),
      tag_(entity_tag(content)) {}

void FixedContent::answer(const ExchangePtr& exchange) const {
  const bool is_packed = accepts_gzip(exchange->request());
  Response response = body_response(type_, is_packed ? packed_ : content_);
  response.tag = tag_;
  response.headers.emplace_back("Vary", "Accept-Encoding");
  if (is_packed) response.headers.emplace_back("Content-Encoding", "gzip");
  exchange->answer(std::move(response));
}

}  // namespace orbwatch::app::web
