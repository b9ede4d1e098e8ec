// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "app/model/configuration_files.h"
#include "app/model/recipe_change.h"
#include "app/ports/web/routes.h"
#include "proc/image/result.h"

namespace orbwatch::app::web {

/// Changes of a recipe as sent.
struct RecipeBody {
  int recipe = 0;  ///< number of the recipe
  RecipeChange change;
  int seconds = kUsualTrial;
};

inline constexpr BodyMember kRecipeMember{"recipe", "Number of the recipe", true, BodyType::Whole};
inline constexpr BodyMember kLimitsMember{
    "limits",
    "Limits of alarms, each {\"alarm\": its number, \"region\", \"signal\", \"limit\": low_alarm, "
    "low_warning, high_warning, high_alarm or hysteresis, \"value\": in the signal's unit, null "
    "for none}",
    false, BodyType::List};
inline constexpr BodyMember kRegionsMember{
    "regions",
    "Regions, each {\"name\", and \"directions\": corners [yaw, pitch] in deg or \"points\": "
    "corners [x, y, z] in the machine frame in mm}; a new one also has \"view\" and "
    "\"hot_spot_threshold\"; {\"name\", \"removed\": true} removes one from the recipe, with its "
    "alarms",
    false, BodyType::List};

/// {"recipe": 1, "limits": [...], "regions": [...], "seconds": 60}, of which one list and the
/// seconds are optional. Errors: not such an object; a member is missing, unknown or of another
/// type; numbers out of range. Reentrant.
Result<RecipeBody> parse_recipe_change(std::string_view body);

}  // namespace orbwatch::app::web
