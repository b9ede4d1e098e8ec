// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace orbwatch::app::cli::support {

/// A configuration file without its comments, in which people note passwords; lines keep their
/// numbers. `name` is its file name: in .xml comments are those of XML, else of TOML and YAML.
/// Reentrant.
std::string without_comments(std::string_view text, std::string_view name);

}  // namespace orbwatch::app::cli::support
