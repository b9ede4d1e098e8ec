// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/caller.h"

#include <strings.h>

#include <optional>

#include "app/ports/web/access/base64.h"
#include "hal/network.h"

namespace orbwatch::app::web {
namespace {

/// Credentials after the scheme in Authorization (RFC 9110, 11.4); nullopt: none.
std::optional<std::string> authorization_by(const Request& request, std::string_view scheme) {
  const std::string* sent = request.header("Authorization");
  if (!sent || sent->size() <= scheme.size() || (*sent)[scheme.size()] != ' ' ||
      ::strncasecmp(sent->c_str(), scheme.data(), scheme.size()) != 0) {
    return std::nullopt;
  }
  const std::size_t begin = sent->find_first_not_of(' ', scheme.size());
  return begin == std::string::npos ? "" : sent->substr(begin);
}

/// The password of a Base64 text "user:password"; empty: malformed.
std::string password_in(const std::string& base64) {
  const std::string text = bytes_of_base64(base64).value_or("");
  const std::size_t colon = text.find(':');
  return colon == std::string::npos ? "" : text.substr(colon + 1);
}

}  // namespace

std::string_view session_cookie(const Request& request) {
  if (!request.is_secure) return kSessionCookie;
  return request.prefix.empty() ? kSecureSessionCookie : kSecurePathCookie;
}

std::string client_address(const Request& request) {
  const bool is_address = request.passage == Passage::Direct || !hal::is_loopback(request.peer);
  return is_address ? request.peer : request.peer + " (by proxy)";
}

Credentials credentials_of(const Request& request) {
  Credentials credentials;
  credentials.peer = client_address(request);
  if (const std::string* cookie = request.cookie(session_cookie(request)))
    credentials.session = *cookie;
  credentials.token = authorization_by(request, "Bearer").value_or("");
  return credentials;
}

Credentials player_credentials_of(const Request& request) {
  Credentials credentials = credentials_of(request);
  if (const auto sent = authorization_by(request, "Basic")) {
    credentials.token = password_in(*sent);
    credentials.is_password = true;
  }
  return credentials;
}

}  // namespace orbwatch::app::web
