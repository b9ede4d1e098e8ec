// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "app/model/measured_recipe.h"
#include "app/ports/web/http/exchange.h"
#include "app/ports/web/routes.h"
#include "proc/signals/region.h"

namespace orbwatch::app::web {

/// Serves a recipe's regions in its views, and coordinates for new corners. Thread-safe.
class RecipeRoutes {
 public:
  /// `selected` returns the number of the selected recipe, on any thread.
  RecipeRoutes(std::vector<MeasuredRecipe> recipes, signals::RegionScene scene,
               std::function<std::uint16_t()> selected)
      : recipes_(std::move(recipes)), scene_(std::move(scene)), selected_(std::move(selected)) {}

  std::vector<Route> routes();

 private:
  void serve_recipe(const ExchangePtr& exchange) const;
  void serve_polygon(const ExchangePtr& exchange) const;
  Result<const MeasuredRecipe*> recipe_of(const Request& request) const;

  const std::vector<MeasuredRecipe> recipes_;
  const signals::RegionScene scene_;
  const std::function<std::uint16_t()> selected_;
};

}  // namespace orbwatch::app::web
