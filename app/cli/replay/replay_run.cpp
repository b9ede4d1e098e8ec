// SPDX-License-Identifier: Apache-2.0
#include "app/cli/replay/replay_run.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ostream>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "app/cli/replay/recorded_sets.h"
#include "app/cli/replay/recorded_site.h"
#include "app/cli/replay/set_meter.h"
#include "app/ports/recorder/export/csv_text.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli {
namespace {

using recorder::csv_field;
using recorder::csv_number;
using recorder::ProcessState;

constexpr std::string_view kMeasurementColumns =
                               "utc_ns,frame_set,component,name,figure,value,unit\n",
                           kDifferenceColumns =
                               "utc_ns,frame_set,component,name,figure,recorded,computed\n";

void write_measurements(std::ostream& csv, std::uint64_t utc, const ProcessState& state) {
  for (const recorder::ComponentFigures& component : state.components) {
    if (component.kind != "region" && component.kind != "alarm") continue;
    for (const recorder::Figure& figure : component.figures) {
      csv << utc << ',' << state.frame_set << ',' << component.kind << ','
          << csv_field(component.name) << ',' << figure.name << ',' << csv_number(figure.value)
          << ',' << figure.unit << '\n';
    }
  }
}

void write_difference(std::ostream& csv, const Difference& difference) {
  csv << difference.utc << ',' << difference.frame_set << ',' << csv_field(difference.kind) << ','
      << csv_field(difference.name) << ',' << csv_field(difference.figure) << ','
      << csv_number(difference.recorded) << ',' << csv_number(difference.computed) << '\n';
}

/// Value of a figure of the system when the set was recorded.
double system_figure(const ProcessState& state, std::string_view name) {
  for (const recorder::ComponentFigures& component : state.components) {
    if (component.kind != "system") continue;
    const auto found = std::ranges::find(component.figures, name, &recorder::Figure::name);
    if (found != component.figures.end()) return found->value;
  }
  return std::nan("");
}

/// Splits NUMBER=FILE; without a number the only recipe of the site.
Result<OtherRecipes> other_recipes(const std::string& word, const files::Resolved& site) {
  if (word.empty()) return OtherRecipes();
  std::uint16_t recipe = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, recipe);
  const bool has_number = error == std::errc() && stop != end && *stop == '=';
  const std::string file = has_number ? std::string(stop + 1, end) : word;
  if (!has_number) {
    if (site.site.recipes.size() != 1) {
      return fail("the recording has " + std::to_string(site.site.recipes.size()) +
                  " recipes; --recipe must be NUMBER=FILE");
    }
    recipe = site.site.recipes.front().number;
  }
  return hal::read_regular_file(file).map([&](const std::string& text) {
    return OtherRecipes{{recipe, text}};
  });
}

Result<files::Resolved> configuration_of(const ReplaySettings& settings) {
  auto reader = hal::mcap::Reader::open(settings.recording);
  if (!reader) return fail(reader.error().message);
  auto site = recorded_site(settings.recording, *reader);
  if (!site || settings.recipe.empty()) return site;
  const auto others = other_recipes(settings.recipe, *site);
  if (!others) return tl::unexpected(others.error());
  return recorded_site(settings.recording, *reader, *others);
}

Result<RecordedSets> sets_of(const ReplaySettings& settings, const files::Resolved& site) {
  std::vector<hal::SyncPolicy> policies;
  for (const auto& camera : site.site.cameras) policies.push_back(camera.sync);
  return RecordedSets::open(settings.recording, site.names.cameras, policies);
}

/// Computed state of a set, as the recorder would have it.
ProcessState state_of(const Status& status, const files::Resolved& site, const RecordedSet& set) {
  const std::chrono::system_clock::time_point utc{std::chrono::nanoseconds(set.utc)};
  return recorder::process_state_of({status, site.names, status.stamp, utc});
}

/// First stamp that is compared.
std::uint64_t comparison_begin(const ReplaySettings& settings, const RecordedSet& first) {
  const double settle = settings.settle.value_or(first.state.frame_set <= 1 ? 0 : kSettle);
  return first.utc + static_cast<std::uint64_t>(settle * 1e9);
}

}  // namespace

Result<ReplayFigures> run_replay(const ReplaySettings& settings, std::ostream& csv,
                                 Progress& progress) {
  progress.begin("reading the recording");
  const auto site = configuration_of(settings);
  if (!site) return tl::unexpected(site.error());
  auto sets = sets_of(settings, *site);
  if (!sets) return tl::unexpected(sets.error());
  auto meter = SetMeter::make(*site, sets->formats());
  if (!meter) return tl::unexpected(meter.error());
  Comparison comparison(settings.tolerance, [&csv](const Difference& difference) {
    write_difference(csv, difference);
  });
  ReplayFigures figures;
  std::uint64_t compared_from = 0;
  progress.begin("measuring");
  while (true) {
    const auto set = sets->next();
    if (!set) return tl::unexpected(set.error());
    if (!*set) break;
    const RecordedSet& recorded = **set;
    const bool is_active = system_figure(recorded.state, "process_active") > 0;
    const auto status =
        meter->measure(recorded.frames, recorded.state.recipe, is_active, recorded.computed);
    if (!status) return tl::unexpected(status.error());
    const ProcessState computed = state_of(**status, *site, recorded);
    if (figures.sets++ == 0) {
      compared_from = comparison_begin(settings, recorded);
      csv << (settings.compares ? kDifferenceColumns : kMeasurementColumns);
    }
    if (!settings.compares) {
      write_measurements(csv, recorded.utc, computed);
    } else if (recorded.utc >= compared_from) {
      comparison.add(recorded.utc, recorded.state, computed);
    }
  }
  progress.erase();
  figures.without_pictures = sets->without_pictures();
  figures.compared = comparison.finish();
  if (figures.sets > 0) return figures;
  return fail(settings.recording.string() + ": no frame set with pictures; " +
              std::to_string(figures.without_pictures) + " without");
}

}  // namespace orbwatch::app::cli
