// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/ports/web/api/route.h"

namespace orbwatch::app::web {

/// Routes of the page's files; index.html is also the root.
std::vector<Route> page_routes();

}  // namespace orbwatch::app::web
