// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/replay/set_meter.h"

#include <algorithm>
#include <string>
#include <utility>

#include "app/daemon/site/site_plan.h"

namespace orbwatch::app::daemon {
namespace {

using CompiledRecipes = std::vector<std::unique_ptr<pipeline::CompiledRecipe>>;

std::vector<pipeline::ViewBuffers::Views> views_of(const CompiledRecipes& recipes) {
  std::vector<pipeline::ViewBuffers::Views> views;
  for (const auto& recipe : recipes) views.emplace_back(recipe->plan().views);
  return views;
}

/// True if alarms are watched: as Measurement decides it, or as it was recorded where the machine
/// or a command decided.
bool is_watched(const pipeline::CompiledRecipe& recipe, bool recorded) {
  switch (recipe.plan().process_active) {
    case pipeline::ActiveSource::Always:
      return true;
    case pipeline::ActiveSource::Detected:
      return recipe.has_hot_spot().value_or(true);
    case pipeline::ActiveSource::Input:
    case pipeline::ActiveSource::Command:
      return recorded;
  }
  return recorded;
}

}  // namespace

Result<SetMeter> SetMeter::make(const files::Resolved& site, std::vector<hal::StreamFormat> formats,
                                std::size_t threads) {
  for (std::size_t k = 0; k < formats.size(); ++k) {
    if (formats[k].width == 0) formats[k] = expected_format(site, k);
  }
  const auto plan = SitePlan::make(site, formats);
  if (!plan) return tl::unexpected(plan.error());
  CompiledRecipes recipes;
  for (std::size_t k = 0; k < plan->recipes.size(); ++k) {
    auto recipe = pipeline::CompiledRecipe::make(plan->recipes[k], plan->scene);
    if (!recipe) return tl::unexpected(in_recipe(site, k, recipe.error()));
    recipes.push_back(std::move(*recipe));
  }
  return SetMeter(std::move(recipes), formats, threads);
}

SetMeter::SetMeter(CompiledRecipes recipes, const std::vector<hal::StreamFormat>& formats,
                   std::size_t threads)
    : recipes_(std::move(recipes)),
      buffers_(std::make_unique<pipeline::ViewBuffers>(pipeline::ViewBuffers::Views(),
                                                       views_of(recipes_), KeptViews{})),
      pyramids_(formats),
      workers_(std::make_unique<pipeline::WorkerPool>(threads)),
      status_(std::make_unique<Status>()) {}

Result<const Status*> SetMeter::measure(const hal::FrameSet& set, std::uint16_t number,
                                        bool process_active, hal::TimePoint now) {
  const auto found = std::ranges::find_if(
      recipes_, [number](const auto& recipe) { return recipe->plan().number == number; });
  if (found == recipes_.end()) {
    return fail("frame set " + std::to_string(set.id) + " was measured with recipe " +
                std::to_string(number) + ", which is not in the recording");
  }
  pipeline::CompiledRecipe& recipe = **found;
  if (std::exchange(recipe_, &recipe) != &recipe) recipe.begin();
  pipeline::PictureUses uses;
  for (const pipeline::ViewChannel& view : recipe.views()) view.add_measured_use(uses);
  pyramids_.build(set, uses, *workers_);
  recipe.render(set, pyramids_, *buffers_, *workers_);
  // The recorded cameras had their settings, or the recorded regions are not measured.
  recipe.measure(hal::TimePoint::min());
  for (pipeline::ViewChannel& view : recipe.views()) view.take();
  recipe.watch(now, is_watched(recipe, process_active), {});

  Status& status = *status_;
  status.frame_set = set.id;
  status.stamp = set.stamp;
  status.trigger = set.trigger.value_or(0);
  status.recipe = number;
  status.process_active = process_active;
  status.region_count = recipe.regions().size();
  std::ranges::copy(recipe.regions(), status.regions.begin());
  status.alarm_count = recipe.alarms().size();
  std::ranges::copy(recipe.alarms(), status.alarms.begin());
  return &status;
}

}  // namespace orbwatch::app::daemon
