#include "app/ports/web/access/caller.h"

#include <strings.h>

namespace orbwatch::app::web {

std::string_view session_cookie(const Request& request) {
  return request.is_secure ? kSecureSessionCookie : kSessionCookie;
}

Credentials credentials_of(const Request& request) {
  constexpr std::string_view kBearer = "Bearer ";
  Credentials credentials{request.peer, {}, {}};
  if (const std::string* cookie = request.cookie(session_cookie(request)))
    credentials.session = *cookie;
  const std::string* sent = request.header("Authorization");
  if (sent && ::strncasecmp(sent->c_str(), kBearer.data(), kBearer.size()) == 0) {
    credentials.token = sent->substr(kBearer.size());
  }
  return credentials;
}

}  // namespace orbwatch::app::web
