// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/build.h"

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include "app/pictures/colour_maps.h"

namespace orbwatch::app::daemon {
namespace {

Result<std::unique_ptr<pipeline::CompiledRecipe>> compile(const files::Resolved& site,
                                                          const SitePlan& plan,
                                                          std::size_t recipe) {
  return pipeline::CompiledRecipe::make(plan.recipes[recipe], plan.scene)
      .map_error([&](const Error& error) { return in_recipe(site, recipe, error); });
}

bool uses(const pipeline::ViewPlan& view, std::size_t camera) {
  return std::ranges::find(view.sources, camera, &pipeline::ViewSource::camera) !=
         view.sources.end();
}

bool uses(const pipeline::RecipePlan& recipe, std::size_t camera) {
  return std::ranges::any_of(
      recipe.views, [camera](const pipeline::ViewPlan& view) { return uses(view, camera); });
}

}  // namespace

Result<pipeline::PipelinePlan> build(const files::Resolved& site, const SitePlan& plan) {
  pipeline::PipelinePlan built;
  static_cast<pipeline::PipelineSettings&>(built) = site.site.pipeline;
  built.views = plan.views;
  for (std::size_t i = 0; i < plan.recipes.size(); ++i) {
    auto recipe = compile(site, plan, i);
    if (!recipe) return tl::unexpected(recipe.error());
    built.recipes.push_back(std::move(*recipe));
  }
  for (const std::string_view map : kColourMapNames) {
    built.colour_maps.push_back(colour_map_table(map));
  }
  built.reserved_cores = site.site.threads.cores.size();
  built.view_count = site.names.views.size();
  built.configuration_checksum = site.checksum;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    built.sync.policies[i] = site.site.cameras[i].sync;
  }
  built.camera_names = site.names.cameras;
  built.formats = plan.formats;
  return built;
}

Result<pipeline::Recompiled> rebuild(const files::Resolved& site,
                                     std::vector<hal::StreamFormat> formats, std::size_t camera) {
  auto plan = SitePlan::make(site, std::move(formats));
  if (!plan) return tl::unexpected(plan.error());
  pipeline::Recompiled recompiled;
  for (std::size_t i = 0; i < plan->views.size(); ++i) {
    if (uses(plan->views[i], camera)) recompiled.sources[i] = std::move(plan->views[i].sources);
  }
  recompiled.recipes.resize(plan->recipes.size());
  for (std::size_t i = 0; i < plan->recipes.size(); ++i) {
    if (!uses(plan->recipes[i], camera)) continue;
    auto recipe = compile(site, *plan, i);
    if (!recipe) return tl::unexpected(recipe.error());
    recompiled.recipes[i] = std::move(*recipe);
  }
  recompiled.formats = std::move(plan->formats);
  return recompiled;
}

}  // namespace orbwatch::app::daemon
