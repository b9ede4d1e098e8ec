#pragma once

#include <string>

#include "app/ports/web/http/message.h"
#include "app/ports/web/web_settings.h"

/// What brings browsers to HTTPS, and keeps them there. All reentrant.
namespace orbwatch::app::web {

/// The answer over HTTP to another computer: the same place over HTTPS; a request that would change
/// something is refused. Nothing that it holds is judged.
Response to_https(const Request& request, int port);

/// The headers besides others over HTTPS. Strict-Transport-Security (RFC 6797) counts for every
/// port of a host, and browsers then let nobody past a certificate that they do not trust: only
/// with an own certificate, and where HTTP and HTTPS have the ports that it turns into each other.
Values https_headers(const WebSettings& settings);

}  // namespace orbwatch::app::web
