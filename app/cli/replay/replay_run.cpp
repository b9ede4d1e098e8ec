// SPDX-License-Identifier: Apache-2.0
#include "app/cli/replay/replay_run.h"

#include <algorithm>
#include <charconv>
#include <ostream>
#include <string_view>
#include <thread>

#include "app/daemon/recordings/recorded_site.h"
#include "app/model/csv_text.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli {
namespace {

using daemon::OtherRecipes;
using recorder::ProcessState;

constexpr std::string_view
    kMeasurementColumns = "utc_ns,frame_set,component,name,figure,value,unit\n",
    kDifferenceColumns = "utc_ns,frame_set,component,name,figure,recorded,computed,explained_by\n";

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

void write_difference(std::ostream& csv, const daemon::Difference& difference) {
  csv << difference.utc << ',' << difference.frame_set << ',' << csv_field(difference.kind) << ','
      << csv_field(difference.name) << ',' << csv_field(difference.figure) << ','
      << csv_number(difference.recorded) << ',' << csv_number(difference.computed) << ','
      << (difference.is_of_jpeg ? "jpeg" : "") << '\n';
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

std::size_t other_cores() { return std::max(1U, std::thread::hardware_concurrency()) - 1; }

daemon::RecipeChoice choice_of(const std::string& word) {
  return [&word](const files::Resolved& site) { return other_recipes(word, site); };
}

}  // namespace

Result<ReplayFigures> run_replay(const ReplaySettings& settings, std::ostream& csv,
                                 Progress& progress, const std::atomic<bool>& is_cancelled) {
  progress.begin("reading the recording");
  auto replay = daemon::Replay::open(settings.recording, choice_of(settings.recipe), other_cores());
  if (!replay) return tl::unexpected(replay.error());
  daemon::Comparison comparison(
      settings.tolerance, replay->jpeg_regions(),
      [&csv](const daemon::Difference& difference) { write_difference(csv, difference); });
  ReplayFigures figures;
  std::uint64_t compared_from = 0;
  progress.begin("measuring");
  while (true) {
    if (is_cancelled) return fail("cancelled");
    const auto set = replay->next();
    if (!set) return tl::unexpected(set.error());
    if (!*set) break;
    const auto& [utc, recorded, computed] = **set;
    if (figures.sets++ == 0) {
      compared_from = comparison_begin(**set, settings.settle);
      csv << (settings.compares ? kDifferenceColumns : kMeasurementColumns);
    }
    if (!settings.compares) {
      write_measurements(csv, utc, computed);
    } else if (utc >= compared_from) {
      comparison.add(utc, recorded, computed);
    }
  }
  progress.erase();
  figures.without_pictures = replay->without_pictures();
  figures.compared = comparison.finish();
  if (figures.sets > 0) return figures;
  return fail(settings.recording.string() + ": no frame set with pictures; " +
              std::to_string(figures.without_pictures) + " without");
}

}  // namespace orbwatch::app::cli
