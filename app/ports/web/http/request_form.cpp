// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/request_form.h"

#include <algorithm>
#include <cctype>

#include "app/ports/web/http/address.h"
#include "app/ports/web/http/forwarding.h"

namespace orbwatch::app::web {
namespace {

constexpr int kBadRequest = 400, kMisdirected = 421;

/// Length of an absolute target's scheme with the two slashes; 0: not an absolute target.
std::size_t scheme_size(std::string_view target) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (equal_in_any_case(target.substr(0, scheme.size()), scheme)) return scheme.size();
  }
  return 0;
}

/// Uses the host in the target instead of the Host header. Its characters are not escaped, so that
/// the decoded path begins with them like the target.
void take_absolute_form(Request& request) {
  const std::size_t scheme = scheme_size(request.target);
  if (scheme == 0) return;
  const std::size_t end =
      std::min(request.target.find_first_of("/?", scheme), request.target.size());
  request.host = request.target.substr(scheme, end - scheme);
  request.target.erase(0, end);
  request.path.erase(0, end);
  if (!request.target.starts_with('/')) request.target.insert(0, "/");
  if (request.path.empty()) request.path = "/";
}

std::size_t count_of(const Request& request, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::count_if(
      request.headers, [name](const auto& sent) { return equal_in_any_case(sent.first, name); }));
}

/// Returns whether a proxy may determine another end of the body (RFC 9112, 6.3), and treat the
/// rest as another request.
bool has_two_lengths(const Request& request) {
  const std::size_t lengths = count_of(request, "Content-Length");
  return lengths > 1 || (lengths == 1 && count_of(request, "Transfer-Encoding") > 0);
}

/// Returns whether `name` is a token (RFC 9110, 5.6.2). The library keeps the space of "Host : a"
/// in the name, which would then differ from the header that a proxy sees (RFC 9112, 5.1).
bool is_token(std::string_view name) {
  constexpr std::string_view kOthers = "!#$%&'*+-.^_`|~";
  return !name.empty() && std::ranges::all_of(name, [&](unsigned char c) {
    return std::isalnum(c) != 0 || kOthers.find(static_cast<char>(c)) != std::string_view::npos;
  });
}

/// Refuses and closes the connection, because the beginning of the next request is uncertain, too.
Response refused_with_its_connection(std::string_view why) {
  Response refusal = error_response(kBadRequest, std::string(why));
  refusal.headers.emplace_back("Connection", "close");
  return refusal;
}

}  // namespace

std::optional<Response> settle_form(Request& request, std::string_view version,
                                    const ServerNames& own) {
  if (request.target.find("%00") != std::string::npos) {
    // The library's C strings end at the zero byte.
    return error_response(kBadRequest, "a path or a query must not contain a zero byte");
  }
  const auto& headers = request.headers;
  if (!std::ranges::all_of(headers, [](const auto& sent) { return is_token(sent.first); })) {
    return refused_with_its_connection("the name of a header is malformed");
  }
  if (has_two_lengths(request)) {
    return refused_with_its_connection("the body's length is stated twice");
  }
  const std::size_t hosts = count_of(request, "Host");
  if (hosts > 1) return error_response(kBadRequest, "the request has more than one Host header");
  if (hosts == 1) request.host = *request.header("Host");
  take_absolute_form(request);
  if (auto taken = take_forwarding(request, own.trusted_proxies); !taken) {
    return error_response(kBadRequest, taken.error().message);
  }
  if (request.host.empty() && hosts == 0 && version == "HTTP/1.0") return std::nullopt;
  const auto host = host_in(request.host);
  if (!host || host->empty()) {
    return error_response(kBadRequest, "the Host header is missing or malformed");
  }
  if (is_own_host(request.host, own.names)) return std::nullopt;
  return error_response(
      kMisdirected,
      "the Host header names another host; add this appliance's names to names of [web]");
}

}  // namespace orbwatch::app::web
