// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/files/text/text_file.h"
#include "app/pipeline/measurement/recipe.h"
#include "proc/image/result.h"

namespace orbwatch::app::files {

/// Reads and checks a recipe's file, except its references to cameras and lines, which resolve()
/// sets. The error states file, line, key, reason and the allowed values.
Result<pipeline::Recipe> load_recipe(const std::filesystem::path& file, TextFiles& files);

/// Parses text in place of a file named `name`.
Result<pipeline::Recipe> parse_recipe(const std::string& text, const std::string& name);

/// Manual of all keys in Markdown.
std::string recipe_manual();

}  // namespace orbwatch::app::files
