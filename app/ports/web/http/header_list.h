// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/web/http/message.h"

/// Lists in the values of headers (RFC 9110, 5.6.1). All reentrant.
namespace orbwatch::app::web {

/// Rule for separators in quoted strings (RFC 9110, 5.6.4); many lists have no such strings.
enum class Quotes { None, Hold };

/// Splits at separators, and removes spaces around the parts. Nullopt: a quoted string has no end,
/// so that it might contain text that a proxy appended.
std::optional<std::vector<std::string_view>> split(std::string_view text, char separator,
                                                   Quotes quotes);

/// The elements of all lines of a header as one list (RFC 9110, 5.3). Nullopt: see split().
std::optional<std::vector<std::string>> list_of(const Request& request, std::string_view name,
                                                Quotes quotes);

/// The elements of a header without quoted strings.
std::vector<std::string> plain_list_of(const Request& request, std::string_view name);

}  // namespace orbwatch::app::web
