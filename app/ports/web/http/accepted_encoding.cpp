// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/accepted_encoding.h"

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "app/ports/web/http/address.h"
#include "app/ports/web/http/header_list.h"

namespace orbwatch::app::web {
namespace {

/// Weight of a coding, the first of `parts` (RFC 9110, 12.4.2). A malformed one counts as 0: the
/// content as it is suits all clients.
double weight_of(const std::vector<std::string_view>& parts) {
  if (parts.size() == 1) return 1;
  const std::string_view text = parts[1];
  if (parts.size() > 2 || !equal_in_any_case(text.substr(0, 2), "q=")) return 0;
  const char* const end = text.data() + text.size();
  double weight = 0;
  const auto parsed = std::from_chars(text.data() + 2, end, weight);
  const bool is_valid = parsed.ec == std::errc() && parsed.ptr == end && weight >= 0 && weight <= 1;
  return is_valid ? weight : 0;
}

}  // namespace

bool accepts_gzip(const Request& request) {
  std::optional<double> gzip, identity, others;
  for (const std::string& element : plain_list_of(request, "Accept-Encoding")) {
    const auto parts = *split(element, ';', Quotes::None);
    const std::string_view coding = parts[0];
    if (equal_in_any_case(coding, "gzip") || equal_in_any_case(coding, "x-gzip")) {
      gzip = weight_of(parts);
    } else if (equal_in_any_case(coding, "identity")) {
      identity = weight_of(parts);
    } else if (coding == "*") {
      others = weight_of(parts);
    }
  }
  const double weight = gzip.value_or(others.value_or(0));
  return weight > 0 && weight >= identity.value_or(0);
}

}  // namespace orbwatch::app::web
