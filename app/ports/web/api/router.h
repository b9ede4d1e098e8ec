// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <tl/expected.hpp>
#include <vector>

#include "app/ports/web/access/caller.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/http/exchange.h"

namespace orbwatch::app::web {

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
