#pragma once

#include <string>

#include "app/model/recipe_change.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// The text of a recipe's file with changes; comments, order and every value that stays are kept
/// byte for byte. `name` is the file's, for messages. Errors: a recipe that is refused before or
/// after; no such alarm or region, or another one than is known; corners of another kind; a place
/// in the text that only a person can change, because comments would be lost or tables have no
/// header.
Result<std::string> changed_recipe(const std::string& text, const std::string& name,
                                   const RecipeChange& change);

}  // namespace orbwatch::app
