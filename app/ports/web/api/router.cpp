// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/api/router.h"

#include <optional>

#include "app/ports/web/http/address.h"

namespace orbwatch::app::web {
namespace {

/// Compares the media type in any case, ignoring its parameters (RFC 9110, 8.3.1).
bool is_json(const std::string* type) {
  if (!type) return false;
  std::string_view essence = std::string_view(*type).substr(0, type->find(';'));
  while (essence.ends_with(' ') || essence.ends_with('\t')) essence.remove_suffix(1);
  return equal_in_any_case(essence, kJson);
}

/// Removes the port that the scheme implies.
std::string_view without_port(std::string_view authority, std::string_view implied) {
  if (authority.ends_with(implied)) authority.remove_suffix(implied.size());
  return authority;
}

/// Returns whether an Origin header is that of our own page. Over HTTP, the same host over HTTPS is
/// accepted, because a proxy may end TLS. Over HTTPS, an origin over HTTP is not accepted, because
/// an attacker may have forged it.
bool is_own_origin(std::string_view origin, const Request& request) {
  constexpr std::string_view kHttp = "http://", kHttps = "https://";
  const bool is_https = origin.starts_with(kHttps);
  if (!is_https && (request.is_secure || !origin.starts_with(kHttp))) return false;
  const std::string_view port = is_https ? ":443" : ":80";
  origin.remove_prefix(is_https ? kHttps.size() : kHttp.size());
  return !request.host.empty() &&
         equal_in_any_case(without_port(origin, port), without_port(request.host, port));
}

/// Checks the headers in which browsers name the page that caused a request; other clients send
/// none. Scripts cannot set Sec-Fetch-Site, and it is independent of a proxy's change of Host.
bool is_from_foreign_page(const Request& request) {
  if (const std::string* site = request.header("Sec-Fetch-Site")) {
    return *site != "same-origin" && *site != "none";
  }
  const std::string* origin = request.header("Origin");
  return origin && !is_own_origin(*origin, request);
}

/// Refusal for the caller's role; nullopt: permitted.
std::optional<Response> refusal_of_role(const Route& route, const Caller& caller) {
  if (caller.role >= route.role) return std::nullopt;
  const std::string needs = route.method + " " + route.path + " needs the role " +
                            std::string(word_for(kRoles, route.role));
  if (caller.role != Role::Nobody) {
    return error_response(
        403, needs + "; " + caller.name + " is " + std::string(word_for(kRoles, caller.role)));
  }
  Response response = error_response(
      401,
      needs + ": log in by POST /api/v1/login, or send the header Authorization: Bearer TOKEN");
  if (route.takes_password) {
    response.headers.emplace_back("WWW-Authenticate", R"(Basic realm="orbwatch", charset="UTF-8")");
  }
  response.headers.emplace_back("WWW-Authenticate", "Bearer");
  return response;
}

/// Refusal of a request that would change something, independent of its role.
std::optional<Response> refusal_of_post(const Request& request) {
  // A page of another host cannot make a browser send this header.
  if (request.cookie(session_cookie(request)) && !request.header(kOwnPageHeader)) {
    return error_response(403, "with a session's cookie the header " + std::string(kOwnPageHeader) +
                                   " is required, with any value");
  }
  if (!is_json(request.header("Content-Type"))) {
    return error_response(415, "the request must have the header Content-Type: application/json");
  }
  return std::nullopt;
}

/// Refusal of a request. A foreign page is refused first, because the logged-in user did not intend
/// its request.
std::optional<Response> refusal_of(const Request& request, const Route& route,
                                   const CallerOf& caller_of) {
  const bool changes = route.method == "POST";
  if (changes && is_from_foreign_page(request)) {
    return error_response(403, "a page of another host caused this request");
  }
  const auto caller = caller_of(request, route);
  if (!caller) return caller.error();
  auto refusal = refusal_of_role(route, *caller);
  return refusal || !changes ? refusal : refusal_of_post(request);
}

}  // namespace

void serve(const std::vector<Route>& routes, const CallerOf& caller_of,
           const ExchangePtr& exchange) {
  const Request& request = exchange->request();
  const std::string_view asked = request.method, method = asked == "HEAD" ? "GET" : asked;
  std::string allowed;
  for (const Route& route : routes) {
    if (route.path != request.path) continue;
    if (route.method == method) {
      auto refusal = refusal_of(request, route, caller_of);
      if (!refusal) return route.serve(exchange);
      exchange->answer(std::move(*refusal));
      return;
    }
    allowed += (allowed.empty() ? "" : ", ") + route.method;
  }
  if (allowed.empty()) {
    exchange->answer(error_response(404, "unknown path"));
    return;
  }
  Response response = error_response(405, "this path allows " + allowed);
  response.headers.emplace_back("Allow", allowed);
  exchange->answer(std::move(response));
}

}  // namespace orbwatch::app::web
