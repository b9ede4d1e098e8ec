// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/message.h"

#include <strings.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace orbwatch::app::web {
namespace {

template <class Matches>
const std::string* first(const Values& values, Matches&& matches) {
  const auto found = std::ranges::find_if(values, matches, &Values::value_type::first);
  return found == values.end() ? nullptr : &found->second;
}

}  // namespace

const std::string* Request::argument(std::string_view name) const {
  return first(query, [name](const std::string& sent) { return sent == name; });
}

const std::string* Request::cookie(std::string_view name) const {
  return first(cookies, [name](const std::string& sent) { return sent == name; });
}

const std::string* Request::header(std::string_view name) const {
  return first(headers, [name](const std::string& sent) {
    return sent.size() == name.size() && ::strncasecmp(sent.data(), name.data(), name.size()) == 0;
  });
}

Response body_response(std::string_view type, Bytes body, int status) {
  Response response;
  response.status = status;
  response.type = type;
  response.body = std::move(body);
  return response;
}

Response body_response(std::string_view type, std::string body, int status) {
  return body_response(type, std::make_shared<const std::string>(std::move(body)), status);
}

Response file_response(std::string_view type, std::shared_ptr<const OpenFile> file) {
  Response response;
  response.type = type;
  response.file = std::move(file);
  return response;
}

Response json_response(std::string text, int status) {
  return body_response(kJson, std::move(text) + "\n", status);
}

Response error_response(int status, const std::string& what) {
  // Invalid UTF-8 from clients is replaced in quotations.
  constexpr auto kReplace = nlohmann::ordered_json::error_handler_t::replace;
  return json_response(nlohmann::ordered_json{{"error", what}}.dump(-1, ' ', false, kReplace),
                       status);
}

}  // namespace orbwatch::app::web
