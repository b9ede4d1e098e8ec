// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "app/files/recipe/recipe_edit.h"
#include "app/ports/web/api/record_schema.h"
#include "app/ports/web/configuration/configuration_records.h"
#include "app/ports/web/configuration/recipe_records.h"

/// Any bytes as a request that changes a recipe, up to the first 0, and as the recipe's file behind
/// it. The file is changed, or refused in one line that names it; repeating the change has no
/// effect, unless it removed a region. The request is also read as one with whole files.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orbwatch::app;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = bytes.find('\0');
  const std::string_view body = bytes.substr(0, end);
  const auto files = web::parse_record<web::ConfigurationBody>(body);
  if (files ? files->seconds < 10 || files->seconds > 3600 : files.error().message.empty()) {
    std::abort();
  }
  auto request = web::parse_record<web::RecipeBody>(body);
  if (!request) {
    if (request.error().message.empty()) std::abort();
    return 0;
  }
  const std::string text(end == std::string_view::npos ? "" : bytes.substr(end + 1));
  const auto changed = orbwatch::app::files::changed_recipe(text, "recipe.toml", request->change);
  if (!changed) {
    const std::string& why = changed.error().message;
    if (!why.starts_with("recipe.toml") || why.find('\n') != std::string::npos) std::abort();
    return 0;
  }
  // Removed regions cannot be removed again, and the numbers of later alarms differ.
  for (auto& region : request->change.regions) {
    if (region.is_removed) return 0;
    region.added.reset();
  }
  const auto again = orbwatch::app::files::changed_recipe(*changed, "recipe.toml", request->change);
  if (!again || *again != *changed) std::abort();
  return 0;
}
