// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cctype>
#include <cstddef>
#include <string_view>

namespace orbwatch::app::cli::support {

/// A part of a text; empty: none.
struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Characters of names of values, options and variables.
inline bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

/// The value of the name that contains the position `at`, in TOML, YAML, JSON, XML, environments,
/// command lines and HTTP headers, with its quotes or brackets; a value without quotes extends to
/// the end of its line. Empty: no value follows, or it is true, false or null. Reentrant.
Span secret_value(std::string_view text, std::size_t at);

}  // namespace orbwatch::app::cli::support
