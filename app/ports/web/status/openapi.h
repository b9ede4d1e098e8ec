#pragma once

#include <string>
#include <vector>

#include "app/ports/web/routes.h"

namespace orbwatch::app::web {

/// The interface as OpenAPI 3.0.3 describes it, in JSON: every route, every command with its
/// arguments, every figure of the status. From the declarations alone; reentrant.
std::string openapi_json(const std::vector<Route>& routes);

}  // namespace orbwatch::app::web
