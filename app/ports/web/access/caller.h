#pragma once

#include <string>

#include "app/model/role.h"
#include "app/ports/web/http/message.h"

namespace orbwatch::app::web {

/// The cookie of a session over HTTP and over HTTPS. Browsers keep cookies of a host whatever the
/// port, and accept one with the prefix __Host- only from its own HTTPS (RFC 6265bis, 4.1.3.2),
/// never from somebody who can change HTTP on the way. It is for the whole host; below a path of a
/// proxy, where other appliances have theirs, __Secure- asks for HTTPS only.
inline constexpr std::string_view kSessionCookie = "orbwatch_session";
inline constexpr std::string_view kSecureSessionCookie = "__Host-orbwatch_session";
inline constexpr std::string_view kSecurePathCookie = "__Secure-orbwatch_session";
/// The one that counts for a request. Reentrant.
std::string_view session_cookie(const Request& request);
/// What changes something by a session must have it: only scripts of our own page can add it.
inline constexpr std::string_view kOwnPageHeader = "X-Orbwatch";

/// Who sent a request.
struct Caller {
  std::string name;  ///< of a user or a token; empty: not known by name
  Role role = Role::Nobody;
};

/// What a request shows to be somebody's.
struct Credentials {
  std::string peer;          ///< client_address()
  std::string session;       ///< of the cookie; empty: none
  std::string token;         ///< of Authorization: Bearer; empty: none
  bool is_password = false;  ///< the token came as the password of HTTP Basic
};

/// The numeric address of who sent a request, for trust, limits and the audit. Whoever a proxy
/// passes on is not on this computer: "127.0.0.1 (by proxy)" is no address of it. Reentrant.
std::string client_address(const Request& request);
/// Reentrant.
Credentials credentials_of(const Request& request);
/// The same where a token may also come as the password of HTTP Basic (RFC 7617), under any name.
Credentials player_credentials_of(const Request& request);

}  // namespace orbwatch::app::web
