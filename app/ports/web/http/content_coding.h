// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "app/ports/web/http/message.h"

/// Content codings (RFC 9110, 8.4). All reentrant.
namespace orbwatch::app::web {

/// Smallest body of JSON that is compressed for a client: below, headers are most of an answer.
inline constexpr std::size_t kLeastPacked = 1024;

/// Compresses like gzip(1); `level` is that of zlib, 1 to 9, the smallest result by default.
std::string gzip(std::string_view content, int level = 9);

/// The response, its body compressed if it is JSON, large enough, and the client accepts gzip.
/// Answers in JSON hold no secrets: sizes of compressed ones could tell them (BREACH).
Response packed_for(const Request& request, Response response);

}  // namespace orbwatch::app::web
