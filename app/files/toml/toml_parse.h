// SPDX-License-Identifier: Apache-2.0
#pragma once

// Without NDEBUG, toml++ 3.3 would end the program if a table's name begins with a wrong character;
// it refuses the text a few lines later anyway.
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <string>

namespace orbwatch::app::files {

/// Largest number of dots, braces and brackets around a value: its depth in the tree of tables,
/// which the library builds and destroys by recursion and limits only for brackets.
inline constexpr int kDeepestToml = 64;

/// Tables of a text from outside. `name` is its file's, for messages. Throws toml::parse_error: the
/// text is not valid TOML, or it is nested deeper than kDeepestToml. Reentrant.
toml::table parse_toml(const std::string& text, const std::string& name = {});

}  // namespace orbwatch::app::files
