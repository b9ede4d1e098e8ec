#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/command.h"
#include "app/ports/web/http/exchange.h"

namespace orbwatch::app::web {

/// Whether a path takes ?view=NAME.
enum class ViewArgument { None, One, Any };

/// What is served under one path.
struct Route {
  std::string method;  ///< GET, which includes HEAD, or POST
  std::string path;
  std::string description;
  std::string type;  ///< of its answer
  std::function<void(const ExchangePtr&)> serve;
  ViewArgument view = ViewArgument::None;
  const CommandInfo* command = nullptr;  ///< the command that it carries out
  bool is_page = false;                  ///< a file of the page, which programs do not ask for
};

/// Passes a request to the route of its method and path, compared exactly; another method is
/// answered 405, another path 404. A POST that a foreign page may have caused is answered 403, and
/// one that is not JSON 415, which no form can send. Reentrant as far as the routes are.
void serve(const std::vector<Route>& routes, const ExchangePtr& exchange);

}  // namespace orbwatch::app::web
