// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/api/route.h"

#include <algorithm>
#include <charconv>

namespace orbwatch::app::web {
namespace {

/// Converts an argument to the type of its schema; a text that is no number remains a text.
Json converted(const std::string& text, const Json& schema) {
  const std::string type = schema.value("type", "");
  const char* const end = text.data() + text.size();
  if (type == "integer") {
    std::int64_t whole = 0;
    const auto parsed = std::from_chars(text.data(), end, whole);
    if (parsed.ec == std::errc() && parsed.ptr == end) return whole;
  }
  if (type == "integer" || type == "number") {
    double number = 0;
    const auto parsed = std::from_chars(text.data(), end, number);
    if (parsed.ec == std::errc() && parsed.ptr == end) return number;
  }
  return text;
}

/// Quotes an argument, which is no secret because it stands in the address.
tl::unexpected<Error> refused_argument(const std::string& name, const std::string& text,
                                       const Json& schema) {
  constexpr std::size_t kMostQuoted = 100;
  return fail(name + " is " + text.substr(0, kMostQuoted) + "; it must be " + form_text(schema));
}

}  // namespace

tl::unexpected<Response> refuse(int status, const std::string& what) {
  return tl::unexpected(error_response(status, what));
}

tl::unexpected<Response> refuse(const Error& error, int status) {
  return refuse(status, error.message);
}

Route with_answer(Route route, SchemaMaker answer) {
  route.answer = std::move(answer);
  return route;
}

Route for_players(Route route) {
  route.takes_password = true;
  return route;
}

Answered<std::size_t> index_of(std::string_view what, const std::string& name,
                               const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string known;
  for (const std::string& other : names) known += (known.empty() ? "" : ", ") + other;
  return refuse(404, "unknown " + std::string(what) + " " + name.substr(0, 100) +
                         "; there are: " + (known.empty() ? "none" : known));
}

Result<Json> parse_query(const Request& request, const Json& schema) {
  Json sent = Json::object();
  const Json& members = schema.at("properties");
  for (const auto& [name, text] : request.query) {
    const auto found = members.find(name);
    if (found == members.end()) continue;
    const bool is_list = found->value("type", "") == "array";
    if (!is_list && sent.contains(name)) continue;
    Json value = converted(text, is_list ? found->at("items") : *found);
    if (is_list) {
      sent[name].push_back(std::move(value));
    } else if (check_form(value, *found, name)) {
      sent[name] = std::move(value);
    } else {
      return refused_argument(name, text, *found);
    }
  }
  return check_form(sent, schema, "").map([&] { return std::move(sent); });
}

}  // namespace orbwatch::app::web
