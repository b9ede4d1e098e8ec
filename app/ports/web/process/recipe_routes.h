// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "app/model/status/measured_recipe.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/process/measured_recipe_records.h"
#include "proc/signals/region.h"

namespace orbwatch::app::web {

/// Serves a recipe's regions in its views, and coordinates for new corners. Thread-safe.
class RecipeRoutes {
 public:
  /// `selected` returns the number of the selected recipe, on any thread.
  RecipeRoutes(std::vector<MeasuredRecipe> recipes, signals::RegionScene scene,
               std::function<std::uint16_t()> selected)
      : recipes_(std::move(recipes)), scene_(std::move(scene)), selected_(std::move(selected)) {}

  Answered<RecipeAnswer> recipe(const RecipeQuery& query) const;
  Answered<PolygonAnswer> polygon(const PolygonQuery& query) const;

 private:
  Answered<const MeasuredRecipe*> recipe_of(const RecipeQuery& query) const;

  const std::vector<MeasuredRecipe> recipes_;
  const signals::RegionScene scene_;
  const std::function<std::uint16_t()> selected_;
};

}  // namespace orbwatch::app::web
