// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "app/model/command/command.h"
#include "app/model/command/role.h"
#include "app/ports/web/api/json_form.h"
#include "app/ports/web/http/exchange.h"

namespace orbwatch::app::web {

/// A value, or the refusal that is answered instead.
template <class T>
using Answered = tl::expected<T, Response>;

/// Refusal with the body {"error": what}. Reentrant.
tl::unexpected<Response> refuse(int status, const std::string& what);
/// Refusal of a result; 409 unless another status is stated. Reentrant.
tl::unexpected<Response> refuse(const Error& error, int status = 409);

/// Schema of a part of a route, made when it is needed; empty: there is no such part.
using SchemaMaker = std::function<Json()>;

/// Route: a method and a path with role, description, arguments, answer and handler.
struct Route {
  std::string method;  ///< GET, which includes HEAD, or POST
  std::string path;
  Role role = Role::Administrator;  ///< least role that is served
  std::string description;
  std::string type;      ///< media type of the answer
  SchemaMaker query{};   ///< arguments of the query, as members of an object
  SchemaMaker body{};    ///< JSON body of the request
  SchemaMaker answer{};  ///< JSON answer
  /// Parses the request, and answers it at once or later.
  std::function<void(const ExchangePtr&)> serve{};
  const CommandInfo* command = nullptr;  ///< command executed by the route
  bool is_page = false;                  ///< a file of the page, not part of the API
  /// Accepts a token as the password, for programs that can send only a name and a password.
  bool takes_password = false;
};

/// Describes the answer of a handler that writes its JSON itself.
Route with_answer(Route route, SchemaMaker answer);

/// Makes a route usable for programs that can send only a name and a password, and no other header.
Route for_players(Route route);

/// Place of a name in the appliance's list. Error: 404 with the names that there are. `what` is
/// "view" or "camera". Reentrant.
Answered<std::size_t> index_of(std::string_view what, const std::string& name,
                               const std::vector<std::string>& names);

/// Arguments in a request's query as an object of this schema: numbers are converted, a list takes
/// each argument of its name. Others are ignored. Error: those of check_form(). Reentrant.
Result<Json> parse_query(const Request& request, const Json& schema);

}  // namespace orbwatch::app::web
