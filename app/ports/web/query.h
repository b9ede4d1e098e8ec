#pragma once

#include <string_view>

#include "app/ports/web/http/message.h"
#include "proc/image/result.h"

namespace orbwatch::app::web {

/// A number of a request's query; `otherwise` when it is not there. Error: it is no number within
/// [lowest, highest], in words for who asked. Reentrant.
Result<double> number_of(const Request& request, std::string_view name, double otherwise,
                         double lowest, double highest);

/// The same, and it must be there.
Result<double> number_of(const Request& request, std::string_view name, double lowest,
                         double highest);

}  // namespace orbwatch::app::web
