// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/query.h"

#include <charconv>
#include <cmath>
#include <string>

#include "app/model/command.h"

namespace orbwatch::app::web {

Result<double> number_of(const Request& request, std::string_view name, double otherwise,
                         double lowest, double highest) {
  const std::string* text = request.argument(name);
  if (!text) return otherwise;
  double value = NAN;
  const char* const end = text->data() + text->size();
  const auto parsed = std::from_chars(text->data(), end, value);
  if (parsed.ec == std::errc() && parsed.ptr == end && value >= lowest && value <= highest) {
    return value;
  }
  return fail(std::string(name) + " is " + *text + "; it must be " +
              range_text({name, "", 0.001, lowest, highest, ""}));
}

Result<double> number_of(const Request& request, std::string_view name, double lowest,
                         double highest) {
  if (request.argument(name)) return number_of(request, name, NAN, lowest, highest);
  return fail(std::string(name) + " is missing; it must be " +
              range_text({name, "", 0.001, lowest, highest, ""}));
}

}  // namespace orbwatch::app::web
