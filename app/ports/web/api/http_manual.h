// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/ports/web/api/route.h"

namespace orbwatch::app::web {

/// Manual of the HTTP interface in Markdown: a table of all routes, then arguments, body and answer
/// of each. Reentrant.
std::string http_manual(const std::vector<Route>& routes);

}  // namespace orbwatch::app::web
