// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "app/model/command.h"
#include "app/model/role.h"
#include "app/ports/web/access/caller.h"
#include "app/ports/web/http/exchange.h"

namespace orbwatch::app::web {

/// Use of ?view=NAME by a path.
enum class ViewArgument { None, One, Any };

/// Query argument ?name=VALUE of a path, besides a view.
struct QueryArgument {
  std::string_view name;
  std::string_view description;
  bool is_required = false;
  bool is_number = true;
};

/// Type of a member of a request's body: a text, texts by name, a whole number, or a list.
enum class BodyType { Text, Texts, Whole, List };

/// A member of the JSON object that is the body of a request.
struct BodyMember {
  std::string_view name;
  std::string_view description;
  bool is_required = true;
  BodyType type = BodyType::Text;
};

/// Route: a path with its method, role, arguments and handler.
struct Route {
  std::string method;  ///< GET, which includes HEAD, or POST
  std::string path;
  Role role = Role::Administrator;  ///< least role that is served
  std::string description;
  std::string type;  ///< media type of the answer
  std::function<void(const ExchangePtr&)> serve;
  ViewArgument view = ViewArgument::None;
  const CommandInfo* command = nullptr;  ///< command executed by the route
  std::vector<BodyMember> body{};        ///< body of a route that is not a command
  std::vector<QueryArgument> query{};
  bool is_page = false;  ///< a file of the page, not part of the API
  /// Accepts a token as the password, for programs that can send only a name and a password.
  bool takes_password = false;
};

/// Returns the sender of a request for a route, or the response if it cannot be determined; never
/// waits.
using CallerOf = std::function<tl::expected<Caller, Response>(const Request&, const Route&)>;

/// Passes a request to the route of its method and path, compared exactly; another method is
/// answered 405, another path 404. A caller whose role is too low is answered 401 or 403. A POST
/// that a foreign page may have caused is answered 403, and one that is not JSON 415, which no form
/// can send. Reentrant as far as the routes are.
void serve(const std::vector<Route>& routes, const CallerOf& caller_of,
           const ExchangePtr& exchange);

}  // namespace orbwatch::app::web
