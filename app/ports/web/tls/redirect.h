// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/ports/web/http/message.h"
#include "app/ports/web/web_settings.h"

/// Redirection of browsers to HTTPS. All reentrant.
namespace orbwatch::app::web {

/// Answer over HTTP to another computer: redirects to the same place over HTTPS; refuses a request
/// that would change something. Credentials in the request are ignored.
Response to_https(const Request& request, int port);

/// Further headers over HTTPS. Strict-Transport-Security (RFC 6797) applies to every port of a
/// host, and browsers then do not let users past an untrusted certificate. So it is sent only with
/// a configured certificate, and only if HTTP and HTTPS have the ports that it maps to each other.
Values https_headers(const WebSettings& settings);

}  // namespace orbwatch::app::web
