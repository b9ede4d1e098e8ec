// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "app/model/configuration/recipe_change.h"
#include "proc/image/result.h"

namespace orbwatch::app::files {

/// The text of a recipe's file with changes; comments, order and every unchanged value are kept
/// byte for byte. `name` is the file's, for messages. Errors: a recipe that is refused before or
/// after; no such alarm or region, or one that differs from the expected one; corners of another
/// kind; corners with a comment between them, which would be lost; those of TomlEdit::finish().
/// A copy gets its name.
Result<std::string> changed_recipe(const std::string& text, const std::string& name,
                                   const RecipeChange& change);

/// Checks the name of a recipe that becomes a file's: 1 to 40 letters, digits, "-" and "_".
/// Reentrant.
Result<> check_recipe_name(const std::string& name);

/// The text of the configuration file `site` with one more recipe, whose file is `file`; the rest
/// is kept byte for byte. Reentrant. Errors: another recipe has this number; those of
/// TomlEdit::finish().
Result<std::string> with_recipe(const std::string& text, const std::string& site,
                                std::uint16_t number, const std::string& file);

}  // namespace orbwatch::app::files
