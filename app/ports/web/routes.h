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

/// Whether a path takes ?view=NAME.
enum class ViewArgument { None, One, Any };

/// A path's ?name=VALUE, besides a view.
struct QueryArgument {
  std::string_view name;
  std::string_view description;
  bool is_required = false;
  bool is_number = true;
};

/// What a member of a request's body is: a text, texts by name, a whole number, or a list.
enum class BodyType { Text, Texts, Whole, List };

/// A member of the JSON object that is the body of a request.
struct BodyMember {
  std::string_view name;
  std::string_view description;
  bool is_required = true;
  BodyType type = BodyType::Text;
};

/// What is served under one path, and to whom.
struct Route {
  std::string method;  ///< GET, which includes HEAD, or POST
  std::string path;
  Role role = Role::Administrator;  ///< the least that it is served to
  std::string description;
  std::string type;  ///< of its answer
  std::function<void(const ExchangePtr&)> serve;
  ViewArgument view = ViewArgument::None;
  const CommandInfo* command = nullptr;  ///< the command that it carries out
  std::vector<BodyMember> body{};        ///< of a route that is no command
  std::vector<QueryArgument> query{};
  bool is_page = false;  ///< a file of the page, which programs do not ask for
  /// True: a token counts as the password, too, for programs that send a name and a password only.
  bool takes_password = false;
};

/// Says who sent a request for a route, or why that is not judged; never waits.
using CallerOf = std::function<tl::expected<Caller, Response>(const Request&, const Route&)>;

/// Passes a request to the route of its method and path, compared exactly; another method is
/// answered 405, another path 404. A caller whose role is too low is answered 401 or 403. A POST
/// that a foreign page may have caused is answered 403, and one that is not JSON 415, which no form
/// can send. Reentrant as far as the routes are.
void serve(const std::vector<Route>& routes, const CallerOf& caller_of,
           const ExchangePtr& exchange);

}  // namespace orbwatch::app::web
