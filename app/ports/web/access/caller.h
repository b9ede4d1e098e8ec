#pragma once

#include <string>

#include "app/model/role.h"
#include "app/ports/web/http/message.h"

namespace orbwatch::app::web {

/// The cookie of a session over HTTP and over HTTPS. Browsers keep cookies of a host whatever the
/// port, and accept one with the prefix __Host- only from its own HTTPS (RFC 6265bis, 4.1.3.2),
/// never from somebody who can change HTTP on the way.
inline constexpr std::string_view kSessionCookie = "orbwatch_session";
inline constexpr std::string_view kSecureSessionCookie = "__Host-orbwatch_session";
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
  std::string peer;     ///< numeric address
  std::string session;  ///< of the cookie; empty: none
  std::string token;    ///< of Authorization: Bearer; empty: none
};

/// Reentrant.
Credentials credentials_of(const Request& request);

}  // namespace orbwatch::app::web
