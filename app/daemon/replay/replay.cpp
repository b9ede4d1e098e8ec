// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/replay/replay.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>
#include <vector>

namespace orbwatch::app::daemon {
namespace {

/// Value of a figure of the system when the set was recorded.
double system_figure(const recorder::ProcessState& state, std::string_view name) {
  for (const recorder::ComponentFigures& component : state.components) {
    if (component.kind != "system") continue;
    const auto found = std::ranges::find(component.figures, name, &recorder::Figure::name);
    if (found != component.figures.end()) return found->value;
  }
  return std::nan("");
}

Result<files::Resolved> configuration_of(const std::filesystem::path& recording,
                                         const RecipeChoice& choose) {
  auto reader = hal::mcap::Reader::open(recording);
  if (!reader) return fail(reader.error().message);
  auto site = recorded_site(recording, *reader);
  if (!site || !choose) return site;
  const auto others = choose(*site);
  if (!others) return tl::unexpected(others.error());
  return others->empty() ? site : recorded_site(recording, *reader, *others);
}

Result<RecordedSets> sets_of(const std::filesystem::path& recording, const files::Resolved& site) {
  std::vector<hal::SyncPolicy> policies;
  for (const auto& camera : site.site.cameras) policies.push_back(camera.sync);
  return RecordedSets::open(recording, site.names.cameras, policies);
}

/// Computed state of a set, as the recorder would have it.
recorder::ProcessState replayed_state(const Status& status, const files::Resolved& site,
                                      std::uint64_t stamp) {
  const std::chrono::system_clock::time_point utc{std::chrono::nanoseconds(stamp)};
  return recorder::process_state_of({status, site.names, status.stamp, utc});
}

}  // namespace

Result<Replay> Replay::open(const std::filesystem::path& recording, const RecipeChoice& choose,
                            std::size_t threads) {
  auto site = configuration_of(recording, choose);
  if (!site) return tl::unexpected(site.error());
  auto sets = sets_of(recording, *site);
  if (!sets) return tl::unexpected(sets.error());
  auto meter = SetMeter::make(*site, sets->formats(), threads);
  if (!meter) return tl::unexpected(meter.error());
  return Replay(std::move(*site), std::move(*sets), std::move(*meter));
}

Result<std::optional<ReplayedSet>> Replay::next() {
  auto set = sets_.next();
  if (!set) return tl::unexpected(set.error());
  if (!*set) return std::nullopt;
  RecordedSet& recorded = **set;
  const bool is_active = system_figure(recorded.state, "process_active") > 0;
  const auto status =
      meter_.measure(recorded.frames, recorded.state.recipe, is_active, recorded.computed);
  if (!status) return tl::unexpected(status.error());
  auto computed = replayed_state(**status, site_, recorded.utc);
  return ReplayedSet{recorded.utc, std::move(recorded.state), std::move(computed)};
}

JpegQualities Replay::jpeg_regions() const {
  JpegQualities regions;
  const auto qualities = sets_.jpeg_qualities();
  for (std::size_t k = 0; k < site_.recipes.size(); ++k) {
    const pipeline::Recipe& recipe = site_.recipes[k];
    for (const auto& region : recipe.regions) {
      const auto view =
          std::ranges::find(recipe.views, region.view.name, &pipeline::ViewSettings::name);
      if (view == recipe.views.end()) continue;
      const auto camera = std::ranges::find(site_.names.cameras, view->measured.name);
      const auto index = static_cast<std::size_t>(camera - site_.names.cameras.begin());
      if (index == qualities.size() || !qualities[index]) continue;
      regions[{site_.site.recipes[k].number, region.name}] = *qualities[index];
    }
  }
  return regions;
}

std::uint64_t comparison_begin(const ReplayedSet& first, std::optional<double> settle) {
  const double seconds = settle.value_or(first.recorded.frame_set <= 1 ? 0 : kSettle);
  return first.utc + static_cast<std::uint64_t>(seconds * 1e9);
}

}  // namespace orbwatch::app::daemon
