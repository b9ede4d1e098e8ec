// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "app/ports/web/http/message.h"

/// Entity tags (RFC 9110, 8.8.3). All reentrant.
namespace orbwatch::app::web {

/// Tag of a content. It is weak, because all encodings of the content have the same.
std::string entity_tag(std::string_view content);

/// A response as the client gets it: 304 without a body if the tag is one of If-None-Match.
Response if_none_match(const Request& request, Response response);

}  // namespace orbwatch::app::web
