// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/model/command/role.h"
#include "app/ports/web/http/message.h"

namespace orbwatch::app::web {

/// The cookie of a session over HTTP and over HTTPS. Browsers keep cookies per host, not per port,
/// and accept one with the prefix __Host- only from the host's own HTTPS (RFC 6265bis, 4.1.3.2),
/// never from an attacker who modifies HTTP. It applies to the whole host; below a path of a proxy,
/// where other appliances have their own, __Secure- only requires HTTPS.
inline constexpr std::string_view kSessionCookie = "orbwatch_session";
inline constexpr std::string_view kSecureSessionCookie = "__Host-orbwatch_session";
inline constexpr std::string_view kSecurePathCookie = "__Secure-orbwatch_session";
/// Name of the session cookie for a request. Reentrant.
std::string_view session_cookie(const Request& request);
/// Header required for changes by a session; only scripts of our own page can add it.
inline constexpr std::string_view kOwnPageHeader = "X-Orbwatch";

/// Identity and role of a request's sender.
struct Caller {
  std::string name;  ///< name of a user or a token; empty: not logged in
  Role role = Role::Nobody;
};

/// Credentials of a request.
struct Credentials {
  std::string peer;          ///< client_address()
  std::string session;       ///< session token of the cookie; empty: none
  std::string token;         ///< token of Authorization: Bearer; empty: none
  bool is_password = false;  ///< the token was sent as the password of HTTP Basic
};

/// Numeric address of a request's sender, for trust, limits and the audit. A client behind a proxy
/// is not on this computer: "127.0.0.1 (by proxy)" is not an address of it. Reentrant.
std::string client_address(const Request& request);
/// Reentrant.
Credentials credentials_of(const Request& request);
/// Like credentials_of(), but a token may also be sent as the password of HTTP Basic (RFC 7617),
/// under any name.
Credentials player_credentials_of(const Request& request);

}  // namespace orbwatch::app::web
