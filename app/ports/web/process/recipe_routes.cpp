// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/process/recipe_routes.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "app/ports/web/process/recipe_text.h"

namespace orbwatch::app::web {
namespace {

const QueryArgument kNumber{"number", "Number of the recipe; default: the selected one", false};
const QueryArgument kPixels{
    "pixels", "u,v,u,v,...: px to the right and down, pixel centres at integers", true, false};

/// Limit of corners per region in a recipe's file.
constexpr std::size_t kMostCorners = 64;
/// Largest distance outside the view, for corners dragged out of it.
constexpr double kFarthest = kMaxSide;

/// Parses pairs of numbers. Error: the text is not entirely pairs of numbers.
Result<std::vector<optics::Vec2>> pixels_of(const std::string& text) {
  std::vector<double> numbers;
  const char *next = text.data(), *const end = next + text.size();
  while (next <= end && numbers.size() <= 2 * kMostCorners) {
    double number = 0;
    const auto parsed = std::from_chars(next, end, number);
    const bool is_right = parsed.ec == std::errc() && std::abs(number) <= kFarthest &&
                          (parsed.ptr == end || *parsed.ptr == ',');
    if (!is_right) break;
    numbers.push_back(number);
    next = parsed.ptr + 1;
  }
  if (next <= end || numbers.size() % 2 != 0 || numbers.size() > 2 * kMostCorners) {
    return fail("pixels is " + text.substr(0, 100) + "; it must be u,v,u,v,... of at most " +
                std::to_string(kMostCorners) + " corners");
  }
  std::vector<optics::Vec2> pixels;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    pixels.push_back({numbers[i], numbers[i + 1]});
  }
  return pixels;
}

void answer(const ExchangePtr& exchange, const Result<std::string>& json, int refused = 400) {
  exchange->answer(json ? json_response(*json) : error_response(refused, json.error().message));
}

}  // namespace

std::vector<Route> RecipeRoutes::routes() {
  Route recipe;
  recipe.method = "GET";
  recipe.path = "/api/v1/recipe";
  recipe.role = Role::Viewer;
  recipe.description =
      "Returns the regions of a recipe with corners and outlines in their views, and limits of "
      "alarms; px, deg, mm. The number is 0 if there is no recipe";
  recipe.type = kJson;
  recipe.query = {kNumber};
  recipe.serve = [this](const ExchangePtr& exchange) { serve_recipe(exchange); };
  Route polygon = recipe;
  polygon.path = "/api/v1/recipe/polygon";
  polygon.description =
      "Returns the polygon whose corners are these pixels of a view of the recipe: as directions, "
      "as points on the scene's surface, and its outline in the view; px, deg, mm";
  polygon.view = ViewArgument::One;
  polygon.query = {kPixels, kNumber};
  polygon.serve = [this](const ExchangePtr& exchange) { serve_polygon(exchange); };
  return {std::move(recipe), std::move(polygon)};
}

/// The requested recipe. Before the pipeline's first report the first recipe is selected; without
/// recipes the result is empty.
Result<const MeasuredRecipe*> RecipeRoutes::recipe_of(const Request& request) const {
  static const MeasuredRecipe kNone;
  const std::string* asked = request.argument(kNumber.name);
  const std::string number = asked ? *asked : std::to_string(selected_());
  const auto found = std::ranges::find_if(recipes_, [&](const MeasuredRecipe& recipe) {
    return std::to_string(recipe.number) == number;
  });
  if (found != recipes_.end()) return &*found;
  if (!asked) return recipes_.empty() ? &kNone : &recipes_.front();
  std::string numbers;
  for (const MeasuredRecipe& recipe : recipes_) {
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(recipe.number);
  }
  return fail("there is no recipe " + number.substr(0, 20) + "; there are: " + numbers);
}

void RecipeRoutes::serve_recipe(const ExchangePtr& exchange) const {
  answer(exchange, recipe_of(exchange->request()).map([](const auto* recipe) {
    return recipe_json(*recipe);
  }),
         404);
}

void RecipeRoutes::serve_polygon(const ExchangePtr& exchange) const {
  const Request& request = exchange->request();
  const auto polygon = [&](const MeasuredRecipe* recipe) -> Result<std::string> {
    const std::string *name = request.argument("view"), *text = request.argument(kPixels.name);
    const auto view = name ? std::ranges::find(recipe->views, *name, &MeasuredRecipe::View::name)
                           : recipe->views.end();
    if (view == recipe->views.end()) {
      return fail("unknown view; pass ?view=NAME with a name from /api/v1/recipe");
    }
    if (!text) return fail("no corners; pass &pixels=u,v,u,v,...");
    return pixels_of(*text).and_then([&](const std::vector<optics::Vec2>& pixels) {
      return polygon_json(*view->projection, scene_, pixels);
    });
  };
  answer(exchange, recipe_of(request).and_then(polygon));
}

}  // namespace orbwatch::app::web
