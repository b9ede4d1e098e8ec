// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/web/http/message.h"
#include "hal/network.h"

namespace orbwatch::app::web {

/// Names of the server, and its trusted proxies.
struct ServerNames {
  std::vector<std::string> names;
  std::vector<hal::Network> trusted_proxies;
};

/// Normalises a request of an HTTP version, "HTTP/1.1": the target's absolute form becomes path and
/// host (RFC 9112, 3.2.2), and a trusted proxy's statements about the client replace the
/// connection's properties. Returns the refusal of a malformed request, 400, or of one for another
/// host, 421. A request of HTTP/1.0, which no browser sends, need not name a host. Reentrant.
std::optional<Response> settle_form(Request& request, std::string_view version,
                                    const ServerNames& own);

}  // namespace orbwatch::app::web
