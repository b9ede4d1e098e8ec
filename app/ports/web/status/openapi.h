// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/ports/web/api/route.h"

namespace orbwatch::app::web {

/// OpenAPI 3.0.3 description of the interface, in JSON: every route with arguments, body and
/// answer. Generated from the declarations only; reentrant.
std::string openapi_json(const std::vector<Route>& routes);

}  // namespace orbwatch::app::web
