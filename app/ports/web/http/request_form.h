#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/web/http/message.h"
#include "hal/network.h"

namespace orbwatch::app::web {

/// The names of the server, and the proxies that it believes.
struct ServerNames {
  std::vector<std::string> names;
  std::vector<hal::Network> trusted_proxies;
};

/// Brings a request of an HTTP version, "HTTP/1.1", into the form that routes judge: the target's
/// absolute form becomes path and host (RFC 9112, 3.2.2), and what a trusted proxy says of the
/// client replaces what the connection shows. Returns the refusal of one that is malformed, 400, or
/// meant for another host, 421. One of HTTP/1.0, which no browser sends, need not name a host.
/// Reentrant.
std::optional<Response> settle_form(Request& request, std::string_view version,
                                    const ServerNames& own);

}  // namespace orbwatch::app::web
