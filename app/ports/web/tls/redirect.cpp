// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/tls/redirect.h"

#include <algorithm>

#include "app/ports/web/http/address.h"

namespace orbwatch::app::web {
namespace {

constexpr int kHttpPort = 80, kHttpsPort = 443;

/// Returns whether `target` can be appended to our own host in a header.
bool is_path(const std::string& target) {
  return target.starts_with('/') &&
         std::ranges::all_of(target, [](char c) { return c > ' ' && c <= '~'; });
}

}  // namespace

Response to_https(const Request& request, int port) {
  const auto host = host_in(request.host);
  if (!host || host->empty()) return error_response(400, "the Host header is missing or malformed");
  std::string place = "https://" + std::string(*host);
  if (port != kHttpsPort) place += ":" + std::to_string(port);
  place += is_path(request.target) ? request.target : "/";
  if (request.method != "GET" && request.method != "HEAD") {
    return error_response(
        403, "other computers are served over HTTPS only: " + place +
                 (request.passage == Passage::UntrustedProxy
                      ? "; through a reverse proxy only if trusted_proxies of [web] has its address"
                      : ""));
  }
  // Temporary, because the port may change.
  constexpr int kTemporaryRedirect = 307;
  Response response = error_response(kTemporaryRedirect, "moved to " + place);
  response.headers.emplace_back("Location", place);
  return response;
}

Values https_headers(const WebSettings& settings) {
  const bool is_strict = !settings.certificate.empty() && settings.port == kHttpPort &&
                         https_port_of(settings) == kHttpsPort;
  if (!is_strict) return {};
  return {{"Strict-Transport-Security", "max-age=31536000"}};
}

}  // namespace orbwatch::app::web
