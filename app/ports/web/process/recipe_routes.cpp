// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/process/recipe_routes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string>

namespace orbwatch::app::web {
namespace {

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

std::vector<std::string> texts_of(const auto& list, const auto& text_of) {
  std::vector<std::string> texts;
  std::ranges::transform(list, std::back_inserter(texts), text_of);
  return texts;
}

}  // namespace

/// The requested recipe. Before the pipeline's first report the first recipe is selected; without
/// recipes the result is empty.
Answered<const MeasuredRecipe*> RecipeRoutes::recipe_of(const RecipeQuery& query) const {
  static const MeasuredRecipe kNone;
  const auto numbers = texts_of(
      recipes_, [](const MeasuredRecipe& recipe) { return std::to_string(recipe.number); });
  const auto found =
      index_of("recipe", std::to_string(query.number.value_or(selected_())), numbers);
  if (found) return &recipes_[*found];
  if (query.number) return tl::unexpected(found.error());
  return recipes_.empty() ? &kNone : &recipes_.front();
}

Answered<RecipeAnswer> RecipeRoutes::recipe(const RecipeQuery& query) const {
  return recipe_of(query).map([this](const MeasuredRecipe* recipe) {
    RecipeAnswer answer = recipe_answer(*recipe);
    for (const MeasuredRecipe& one : recipes_) answer.recipes.push_back({one.number, one.name});
    return answer;
  });
}

Answered<PolygonAnswer> RecipeRoutes::polygon(const PolygonQuery& query) const {
  const auto recipe = recipe_of(query.recipe);
  if (!recipe) return tl::unexpected(recipe.error());
  const auto& views = (*recipe)->views;
  const auto view = index_of("view", query.view, texts_of(views, &MeasuredRecipe::View::name));
  if (!view) return tl::unexpected(view.error());
  const auto polygon = pixels_of(query.pixels).and_then([&](const auto& pixels) {
    return polygon_answer(*views[*view].projection, scene_, pixels);
  });
  if (!polygon) return refuse(polygon.error(), 400);
  return *polygon;
}

}  // namespace orbwatch::app::web
