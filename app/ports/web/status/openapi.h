// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/ports/web/routes.h"

namespace orbwatch::app::web {

/// OpenAPI 3.0.3 description of the interface, in JSON: every route, every command with its
/// arguments, every figure of the status. Generated from the declarations only; reentrant.
std::string openapi_json(const std::vector<Route>& routes);

}  // namespace orbwatch::app::web
