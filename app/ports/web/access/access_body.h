// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/web/routes.h"
#include "proc/image/result.h"

namespace orbwatch::app::web {

/// Texts of a body by name; an omitted one is empty.
using Members = std::map<std::string, std::string, std::less<>>;

/// Parses a JSON object with these texts. Errors: not an object; a member is missing, unknown or
/// not a string. Never quotes a value, which may be a password. Reentrant.
Result<Members> parse_members(const std::vector<BodyMember>& allowed, std::string_view body);

}  // namespace orbwatch::app::web
