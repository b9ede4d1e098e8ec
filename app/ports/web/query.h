// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "app/ports/web/http/message.h"
#include "proc/image/result.h"

namespace orbwatch::app::web {

/// Number in a request's query; `otherwise` if it is absent. Error: not a number within [lowest,
/// highest], with a text for the client. Reentrant.
Result<double> number_of(const Request& request, std::string_view name, double otherwise,
                         double lowest, double highest);

/// Required number in a request's query.
Result<double> number_of(const Request& request, std::string_view name, double lowest,
                         double highest);

}  // namespace orbwatch::app::web
