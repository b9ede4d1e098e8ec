#pragma once

#include <filesystem>
#include <string>

#include "app/files/text_file.h"
#include "app/pipeline/measurement/recipe.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Reads and checks a recipe's file, all but its references to cameras and lines, which resolve()
/// sets. The error says file, line, key, what is wrong and what is allowed.
Result<Recipe> load_recipe(const std::filesystem::path& file, TextFiles& files);

/// The same for text that stands in for a file named `name`.
Result<Recipe> parse_recipe(const std::string& text, const std::string& name);

/// The manual of all keys in Markdown.
std::string recipe_manual();

}  // namespace orbwatch::app
