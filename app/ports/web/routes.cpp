#include "app/ports/web/routes.h"

#include <optional>

namespace orbwatch::app::web {
namespace {

/// Of the type alone, without its parameters.
bool is_json(const std::string* type) {
  return type && (*type == kJson || type->starts_with(std::string(kJson) + ";"));
}

/// By what browsers say about the page that caused a request; other clients say nothing.
bool is_from_foreign_page(const Request& request) {
  const std::string* site = request.header("Sec-Fetch-Site");
  if (site && *site != "same-origin" && *site != "none") return true;
  const std::string* origin = request.header("Origin");
  const std::string* host = request.header("Host");
  return origin && (!host || *origin != (request.is_secure ? "https://" : "http://") + *host);
}

/// Nullopt: the caller may do this.
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
  response.headers.emplace_back("WWW-Authenticate", "Bearer");
  return response;
}

/// Why a request that would change something is refused.
std::optional<Response> refusal_of_post(const Request& request) {
  if (is_from_foreign_page(request)) {
    return error_response(403, "a page of another host caused this request");
  }
  // No page of another host can make a browser send this header.
  if (request.cookie(session_cookie(request)) && !request.header(kOwnPageHeader)) {
    return error_response(403, "with a session's cookie the header " + std::string(kOwnPageHeader) +
                                   " must be there, with any value");
  }
  if (!is_json(request.header("Content-Type"))) {
    return error_response(415, "the header must say Content-Type: application/json");
  }
  return std::nullopt;
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
      auto refusal = refusal_of_role(route, caller_of(request));
      if (!refusal && method == "POST") refusal = refusal_of_post(request);
      if (!refusal) return route.serve(exchange);
      exchange->answer(std::move(*refusal));
      return;
    }
    allowed += (allowed.empty() ? "" : ", ") + route.method;
  }
  if (allowed.empty()) {
    exchange->answer(error_response(404, "there is nothing under this path"));
    return;
  }
  Response response = error_response(405, "this path allows " + allowed);
  response.headers.emplace_back("Allow", allowed);
  exchange->answer(std::move(response));
}

}  // namespace orbwatch::app::web
