// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace orbwatch::app::web {

/// Manual of the whole HTTP interface: http_manual() of routes_of(), without a server. Reentrant.
std::string manual_of_all_routes();

}  // namespace orbwatch::app::web
