// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/ports/web/http/message.h"
#include "hal/network.h"
#include "proc/image/result.h"

/// Requests forwarded by reverse proxies. All reentrant.
namespace orbwatch::app::web {

/// Returns whether a header, regardless of its value, shows that a proxy forwarded the request:
/// Forwarded (RFC 7239), Via, X-Real-IP or any X-Forwarded-*.
bool is_passed_on(const Values& headers);

/// Returns whether a connection's numeric address is in `trusted`.
bool is_trusted(const std::string& peer, const std::vector<hal::Network>& trusted);

/// Sets the passage of a request. For a trusted proxy also sets, as far as the headers state them,
/// the client's address (the last one in X-Forwarded-For or Forwarded that is not trusted), host
/// and prefix, and whether the client used HTTPS. Errors: Forwarded and X-Forwarded-For name
/// different clients, so that the client may have forged one of them; Forwarded is malformed; the
/// prefix is not a path.
Result<> take_forwarding(Request& request, const std::vector<hal::Network>& trusted);

}  // namespace orbwatch::app::web
