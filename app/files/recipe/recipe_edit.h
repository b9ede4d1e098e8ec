// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/model/configuration/recipe_change.h"
#include "proc/image/result.h"

namespace orbwatch::app::files {

/// The text of a recipe's file with changes; comments, order and every unchanged value are kept
/// byte for byte. `name` is the file's, for messages. Errors: a recipe that is refused before or
/// after; no such alarm or region, or one that differs from the expected one; corners of another
/// kind; corners with a comment between them, which would be lost; those of TomlEdit::finish().
Result<std::string> changed_recipe(const std::string& text, const std::string& name,
                                   const RecipeChange& change);

}  // namespace orbwatch::app::files
