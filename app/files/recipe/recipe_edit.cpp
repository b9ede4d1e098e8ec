// SPDX-License-Identifier: Apache-2.0
#include "app/files/recipe/recipe_edit.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "app/files/recipe/recipe_file.h"
#include "app/files/toml/finding.h"
#include "app/files/toml/toml_edit.h"
#include "app/files/toml/toml_text.h"

namespace orbwatch::app::files {
namespace {

template <std::size_t N>
std::string toml_corners(const std::vector<std::array<double, N>>& corners) {
  std::string text;
  for (const auto& corner : corners) text += (text.empty() ? "[" : ", ") + toml_list(corner);
  return text + "]";
}

template <std::size_t N>
bool is_at(const toml::node& node, const std::array<double, N>& corner) {
  const toml::array& stated = *node.as_array();
  for (std::size_t i = 0; i < N; ++i) {
    if (stated[i].value<double>() != corner[i]) return false;
  }
  return true;
}

class RecipeEdit {
 public:
  RecipeEdit(TomlEdit edit, pipeline::Recipe recipe)
      : edit_(std::move(edit)), recipe_(std::move(recipe)) {}

  Result<> change(const LimitChange& change);
  Result<> add_alarms(const std::vector<LimitChange>& limits);
  Result<> change(const RegionChange& change);
  void rename(const std::string& name) {
    edit_.replace(*edit_.root().get("name"), toml_string(name));
  }

  Result<std::string> finish() const { return edit_.finish(); }

 private:
  /// The recipe was read, therefore there is a list of tables.
  const toml::array& regions() const { return *edit_.root()["region"].as_array(); }
  const toml::table& region_at(std::size_t index) const { return *regions()[index].as_table(); }

  template <std::size_t N>
  Result<> set_corners(const toml::table& region, const char* key,
                       const std::vector<std::array<double, N>>& corners);
  void add(const RegionChange& change);

  TomlEdit edit_;
  pipeline::Recipe recipe_;
};

Result<> check_limit(const LimitChange& change) {
  const bool is_limit =
      change.limit == signals::kHysteresis ||
      std::ranges::count(signals::kLimits, std::string_view(change.limit),
                         [](const auto& limit) { return std::string_view(limit.name); }) > 0;
  if (!is_limit) return fail("an alarm has no limit \"" + change.limit + "\"");
  return {};
}

/// Adds the alarms whose number is 0, one for each region and signal.
Result<> RecipeEdit::add_alarms(const std::vector<LimitChange>& limits) {
  std::map<std::size_t, std::map<std::string, std::string>> lines;  // by region and signal
  for (const LimitChange& limit : limits) {
    if (limit.alarm != 0) continue;
    const auto found =
        std::ranges::find(recipe_.regions, limit.region, &pipeline::RegionOfInterest::name);
    if (found == recipe_.regions.end()) return fail("there is no region " + limit.region);
    if (!limit.value) return fail("a new alarm must have a value of " + limit.limit);
    const auto region = static_cast<std::size_t>(found - recipe_.regions.begin());
    std::string& alarm = lines[region][limit.signal];
    if (alarm.empty()) alarm = toml_line("signal", toml_string(limit.signal));
    alarm += toml_line(limit.limit, toml_number(*limit.value));
  }
  for (const auto& [region, alarms] : lines) {
    const toml::array* present = region_at(region)["alarm"].as_array();
    std::vector<std::string> added;
    for (const auto& [signal, alarm] : alarms) {
      present ? edit_.add_element(*present, "region.alarm", alarm) : added.push_back(alarm);
    }
    if (!present) edit_.add_list(region_at(region), "region.alarm", added);
  }
  return {};
}

Result<> RecipeEdit::change(const LimitChange& change) {
  std::size_t before = 0;
  for (std::size_t i = 0; i < recipe_.regions.size(); ++i) {
    const pipeline::RegionOfInterest& region = recipe_.regions[i];
    if (change.alarm <= before || change.alarm > before + region.alarms.size()) {
      before += region.alarms.size();
      continue;
    }
    const std::size_t index = change.alarm - before - 1;
    const std::string_view signal = signals::kSignals[region.alarms[index].signal].name;
    const std::string what = "alarm " + std::to_string(change.alarm);
    if (region.name != change.region || signal != change.signal) {
      return fail(what + " watches " + std::string(signal) + " of region " + region.name +
                  ", not " + change.signal + " of " + change.region +
                  ": the file has changed meanwhile");
    }
    const toml::table& table = *(*region_at(i)["alarm"].as_array())[index].as_table();
    change.value ? edit_.set(table, change.limit, toml_number(*change.value))
                 : edit_.remove(table, change.limit);
    return {};
  }
  return fail("there is no alarm " + std::to_string(change.alarm) + " of " +
              std::to_string(before));
}

Result<> RecipeEdit::change(const RegionChange& change) {
  const auto found =
      std::ranges::find(recipe_.regions, change.name, &pipeline::RegionOfInterest::name);
  const bool is_there = found != recipe_.regions.end();
  const bool is_new = change.added && !change.is_removed;
  if (!is_there && !is_new) return fail("there is no region " + change.name);
  if (is_there && is_new) return fail("there is a region " + change.name + " already");
  const bool has_corners = change.directions.empty() != change.points.empty();
  if (!change.is_removed && !has_corners) {
    return fail("region " + change.name + ": corners are either directions or points");
  }
  if (is_new) {
    add(change);
    return {};
  }
  const auto& region = region_at(static_cast<std::size_t>(found - recipe_.regions.begin()));
  if (change.is_removed) {
    edit_.remove(region);
    return {};
  }
  const bool is_other = change.points.empty() ? !found->points.empty() : !found->directions.empty();
  const auto done = is_other                ? fail(change.points.empty() ? "its corners are points"
                                                                         : "its corners are directions")
                    : change.points.empty() ? set_corners(region, "directions", change.directions)
                                            : set_corners(region, "points", change.points);
  return done ? done : fail("region " + change.name + ": " + done.error().message);
}

/// Sets corner by corner, so that the text between them is kept.
template <std::size_t N>
Result<> RecipeEdit::set_corners(const toml::table& region, const char* key,
                                 const std::vector<std::array<double, N>>& corners) {
  const toml::node* given = region.get(key);
  const auto has_comment = [this](const toml::node& node) {
    return edit_.text_of(node).find('#') != std::string_view::npos;
  };
  const Error lost{"there is a comment between its corners, which only a person can change"};
  if (!given || given->as_array()->size() != corners.size()) {
    if (given && has_comment(*given)) return tl::unexpected(lost);
    edit_.set(region, key, toml_corners(corners));
    return {};
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const toml::node& corner = (*given->as_array())[i];
    if (is_at(corner, corners[i])) continue;
    if (has_comment(corner)) return tl::unexpected(lost);
    edit_.replace(corner, toml_list(corners[i]));
  }
  return {};
}

void RecipeEdit::add(const RegionChange& change) {
  const std::string corners = change.points.empty()
                                  ? toml_line("directions", toml_corners(change.directions))
                                  : toml_line("points", toml_corners(change.points));
  edit_.add_element(
      regions(), "region",
      toml_line("name", toml_string(change.name)) +
          toml_line("view", toml_string(change.added->view)) + corners +
          toml_line("hot_spot_threshold", toml_number(change.added->hot_spot_threshold)));
}

Result<> apply(RecipeEdit& edit, const RecipeChange& change) {
  for (const LimitChange& limit : change.limits) {
    if (auto done = check_limit(limit); !done) return done;
    if (limit.alarm == 0) continue;
    if (auto done = edit.change(limit); !done) return done;
  }
  if (auto done = edit.add_alarms(change.limits); !done) return done;
  for (const RegionChange& region : change.regions) {
    if (auto done = edit.change(region); !done) return done;
  }
  if (change.copy) edit.rename(change.copy->name);
  return {};
}

Result<> check_once(const RecipeChange& change) {
  std::set<std::string> seen;
  for (const LimitChange& limit : change.limits) {
    const std::string alarm = limit.alarm > 0 ? "alarm " + std::to_string(limit.alarm)
                                              : "new alarm of " + limit.region + " " + limit.signal;
    if (!seen.insert(alarm + " " + limit.limit).second) {
      return fail(alarm + ": " + limit.limit + " is there twice");
    }
  }
  seen.clear();
  for (const RegionChange& region : change.regions) {
    if (!seen.insert(region.name).second) return fail("region " + region.name + " is there twice");
    const bool is_limited = region.is_removed && std::ranges::count(change.limits, region.name,
                                                                    &LimitChange::region) > 0;
    if (is_limited) return fail("region " + region.name + " is removed, and limits of it changed");
  }
  return {};
}

/// Edits a recipe that was read from the text.
Result<std::string> edited(const std::string& text, const std::string& name,
                           const RecipeChange& change, pipeline::Recipe recipe) {
  auto toml = TomlEdit::make(text, name);
  if (!toml) return tl::unexpected(toml.error());
  RecipeEdit edit(std::move(*toml), std::move(recipe));
  const auto done = check_once(change).and_then([&] { return apply(edit, change); });
  if (!done) return fail(one_line(name + ": " + done.error().message));
  return edit.finish();
}

}  // namespace

Result<std::string> changed_recipe(const std::string& text, const std::string& name,
                                   const RecipeChange& change) {
  const auto read = [&name](const std::string& recipe) { return parse_recipe(recipe, name); };
  return read(text)
      .and_then(
          [&](pipeline::Recipe recipe) { return edited(text, name, change, std::move(recipe)); })
      .and_then([&](const std::string& changed) {
        return read(changed).map([&](const pipeline::Recipe&) { return changed; });
      });
}

Result<> check_recipe_name(const std::string& name) {
  constexpr std::size_t kMost = 40;
  const bool is_plain = std::ranges::all_of(
      name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; });
  if (is_plain && !name.empty() && name.size() <= kMost) return {};
  return fail("the name of a new recipe is \"" + one_line(name.substr(0, kMost)) +
              "\"; it must be 1 to " + std::to_string(kMost) +
              " letters, digits, - and _, because its file has it, too");
}

Result<std::string> with_recipe(const std::string& text, const std::string& site,
                                std::uint16_t number, const std::string& file) {
  auto edit = TomlEdit::make(text, site);
  if (!edit) return tl::unexpected(edit.error());
  const toml::array* const recipes = edit->root()["recipe"].as_array();
  if (recipes == nullptr || recipes->empty()) return fail(site + ": names no recipe to copy");
  for (const toml::node& recipe : *recipes) {
    if (recipe.is_table() && recipe.as_table()->get_as<std::int64_t>("number") != nullptr &&
        **recipe.as_table()->get_as<std::int64_t>("number") == number) {
      return fail(site + ": recipe " + std::to_string(number) +
                  " exists already; choose another number");
    }
  }
  edit->add_element(
      *recipes, "recipe",
      toml_line("number", std::to_string(number)) + toml_line("file", toml_string(file)));
  return edit->finish();
}

}  // namespace orbwatch::app::files
