// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/entity_tag.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "app/ports/web/http/header_list.h"

namespace orbwatch::app::web {
namespace {

constexpr int kNotModified = 304;
constexpr std::string_view kWeak = "W/";

/// The tag without the mark of a weak one, which a proxy adds when it compresses.
std::string_view opaque(std::string_view tag) {
  if (tag.starts_with(kWeak)) tag.remove_prefix(kWeak.size());
  return tag;
}

}  // namespace

std::string entity_tag(std::string_view content) {
  // FNV-1a of 64 bits
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : content) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  char text[21];
  std::snprintf(text, sizeof text, "W/\"%016llx\"", static_cast<unsigned long long>(hash));
  return text;
}

Response if_none_match(const Request& request, Response response) {
  if (response.tag.empty()) return response;
  // Our tags have no comma, so that a part of another server's never equals one.
  const bool is_known = std::ranges::any_of(
      plain_list_of(request, "If-None-Match"),
      [&](const std::string& tag) { return tag == "*" || opaque(tag) == opaque(response.tag); });
  if (!is_known) return response;
  response.status = kNotModified;
  response.body = nullptr;
  std::erase_if(response.headers,
                [](const auto& header) { return header.first == "Content-Encoding"; });
  return response;
}

}  // namespace orbwatch::app::web
