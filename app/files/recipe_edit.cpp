// SPDX-License-Identifier: Apache-2.0
#include "app/files/recipe_edit.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "app/files/recipe_file.h"
#include "app/files/toml_edit.h"
#include "app/files/toml_text.h"

namespace orbwatch::app {
namespace {

template <std::size_t N>
std::string toml_corner(const std::array<double, N>& corner) {
  std::string text;
  for (const double value : corner) text += (text.empty() ? "[" : ", ") + toml_number(value);
  return text + "]";
}

template <std::size_t N>
std::string toml_corners(const std::vector<std::array<double, N>>& corners) {
  std::string text;
  for (const auto& corner : corners) text += (text.empty() ? "[" : ", ") + toml_corner(corner);
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

/// Edits a text and keeps the tables that it must state: any other result is refused.
class RecipeEdit {
 public:
  RecipeEdit(TomlEdit edit, Recipe recipe)
      : edit_(std::move(edit)), recipe_(std::move(recipe)), intended_(edit_.root()) {}

  Result<> change(const LimitChange& change);
  Result<> change(const RegionChange& change);

  std::string text() const { return edit_.text(); }
  bool is_intended(const std::string& text) const { return parse_toml(text) == intended_; }

 private:
  /// One table, both in the text and in the intended result.
  struct Place {
    const toml::table* given;
    toml::table* intended;
  };

  Place region_at(std::size_t index);
  Result<> set(const Place& place, const std::string& key, const std::string& value);
  template <std::size_t N>
  Result<> set_corners(const Place& region, const char* key,
                       const std::vector<std::array<double, N>>& corners);
  Result<> add(const RegionChange& change);
  Result<> remove(std::size_t index);

  TomlEdit edit_;
  Recipe recipe_;
  toml::table intended_;
};

/// The recipe was read, therefore there is a list of tables.
RecipeEdit::Place RecipeEdit::region_at(std::size_t index) {
  const auto at = [index](auto& root) { return (*root["region"].as_array())[index].as_table(); };
  return {at(edit_.root()), at(intended_)};
}

Result<> RecipeEdit::set(const Place& place, const std::string& key, const std::string& value) {
  if (place.given->is_inline() && !place.given->contains(key)) {
    return fail("has no place for " + key + "; write its table with a header of its own");
  }
  edit_.set(*place.given, key, value);
  const toml::table stated = toml::parse("value = " + value);
  stated.get("value")->visit(
      [&](const auto& node) { place.intended->insert_or_assign(key, node); });
  return {};
}

Result<> RecipeEdit::change(const LimitChange& change) {
  const bool is_limit =
      change.limit == signals::kHysteresis ||
      std::ranges::count(signals::kLimits, std::string_view(change.limit),
                         [](const auto& limit) { return std::string_view(limit.name); }) > 0;
  if (!is_limit) return fail("an alarm has no limit \"" + change.limit + "\"");
  std::size_t before = 0;
  for (std::size_t i = 0; i < recipe_.regions.size(); ++i) {
    const RegionOfInterest& region = recipe_.regions[i];
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
    const Place outer = region_at(i);
    const auto at = [index](auto& table) { return (*table["alarm"].as_array())[index].as_table(); };
    const Place alarm{at(*outer.given), at(*outer.intended)};
    if (change.value) {
      const auto done = set(alarm, change.limit, toml_number(*change.value));
      return done ? done : fail(what + " " + done.error().message);
    }
    edit_.remove(*alarm.given, change.limit);
    alarm.intended->erase(change.limit);
    return {};
  }
  return fail("there is no alarm " + std::to_string(change.alarm) + " of " +
              std::to_string(before));
}

Result<> RecipeEdit::change(const RegionChange& change) {
  const auto found = std::ranges::find(recipe_.regions, change.name, &RegionOfInterest::name);
  const bool is_there = found != recipe_.regions.end();
  if (change.is_removed) {
    return is_there ? remove(static_cast<std::size_t>(found - recipe_.regions.begin()))
                    : fail("there is no region " + change.name);
  }
  if (change.directions.empty() == change.points.empty()) {
    return fail("region " + change.name + ": corners are either directions or points");
  }
  if (change.added) {
    return is_there ? fail("there is a region " + change.name + " already") : add(change);
  }
  if (!is_there) return fail("there is no region " + change.name);
  const Place place = region_at(static_cast<std::size_t>(found - recipe_.regions.begin()));
  const bool is_other = change.points.empty() ? !found->points.empty() : !found->directions.empty();
  const auto done = is_other                ? fail(change.points.empty() ? "its corners are points"
                                                                         : "its corners are directions")
                    : change.points.empty() ? set_corners(place, "directions", change.directions)
                                            : set_corners(place, "points", change.points);
  return done ? done : fail("region " + change.name + ": " + done.error().message);
}

/// Sets corner by corner, so that the text between them is kept.
template <std::size_t N>
Result<> RecipeEdit::set_corners(const Place& region, const char* key,
                                 const std::vector<std::array<double, N>>& corners) {
  const toml::node* given = region.given->get(key);
  const auto has_comment = [this](const toml::node& node) {
    return edit_.text_of(node).find('#') != std::string_view::npos;
  };
  const Error lost{"there is a comment between its corners, which only a person can change"};
  if (!given || given->as_array()->size() != corners.size()) {
    if (given && has_comment(*given)) return tl::unexpected(lost);
    return set(region, key, toml_corners(corners));
  }
  toml::array& intended = *region.intended->get(key)->as_array();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const toml::node& corner = (*given->as_array())[i];
    if (is_at(corner, corners[i])) continue;
    if (has_comment(corner)) return tl::unexpected(lost);
    edit_.replace(corner, toml_corner(corners[i]));
    const toml::table stated = toml::parse("value = " + toml_corner(corners[i]));
    intended.replace(intended.cbegin() + static_cast<std::ptrdiff_t>(i),
                     *stated.get("value")->as_array());
  }
  return {};
}

Result<> RecipeEdit::add(const RegionChange& change) {
  const std::string lines =
      "\n[[region]]\n" + toml_line("name", toml_string(change.name)) +
      toml_line("view", toml_string(change.added->view)) +
      (change.points.empty() ? toml_line("directions", toml_corners(change.directions))
                             : toml_line("points", toml_corners(change.points))) +
      toml_line("hot_spot_threshold", toml_number(change.added->hot_spot_threshold));
  edit_.append(*region_at(recipe_.regions.size() - 1).given, lines);
  toml::table stated = toml::parse(lines);
  intended_["region"].as_array()->push_back(std::move((*stated["region"].as_array())[0]));
  return {};
}

/// Removes a region; its alarms are tables within it. Must be the last change, since it moves
/// places in the intended result.
Result<> RecipeEdit::remove(std::size_t index) {
  const std::string& name = recipe_.regions[index].name;
  const toml::table& given = *(*edit_.root()["region"].as_array())[index].as_table();
  if (given.is_inline()) {
    return fail("region " + name + ": cannot be removed; write its table with a header of its own");
  }
  edit_.remove(given);
  toml::array& regions = *intended_["region"].as_array();
  const auto is_named = [&name](const toml::node& region) {
    return region.at_path("name").value<std::string>() == name;
  };
  regions.erase(std::ranges::find_if(regions, is_named));
  return {};
}

/// Applies changes inside the text before additions at its end; removals come last.
Result<> apply(RecipeEdit& edit, const RecipeChange& change) {
  for (const LimitChange& limit : change.limits) {
    if (auto done = edit.change(limit); !done) return done;
  }
  const auto order = [](const RegionChange& region) {
    return region.is_removed ? 2 : region.added ? 1 : 0;
  };
  for (const int turn : {0, 1, 2}) {
    for (const RegionChange& region : change.regions) {
      if (order(region) != turn) continue;
      if (auto done = edit.change(region); !done) return done;
    }
  }
  return {};
}

Result<> check_once(const RecipeChange& change) {
  std::set<std::string> seen;
  for (const LimitChange& limit : change.limits) {
    if (!seen.insert(std::to_string(limit.alarm) + " " + limit.limit).second) {
      return fail("alarm " + std::to_string(limit.alarm) + ": " + limit.limit + " is there twice");
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

/// Edits a recipe. Throws the exceptions of toml++ for names that are not UTF-8.
Result<std::string> edited(const std::string& text, const std::string& name,
                           const RecipeChange& change, Recipe recipe) {
  auto toml = TomlEdit::make(text, name);
  if (!toml) return tl::unexpected(toml.error());
  RecipeEdit edit(std::move(*toml), std::move(recipe));
  const auto done = check_once(change).and_then([&] { return apply(edit, change); });
  if (!done) return fail(name + ": " + done.error().message);
  std::string changed = edit.text();
  if (const auto after = parse_recipe(changed, name); !after) return tl::unexpected(after.error());
  if (edit.is_intended(changed)) return changed;
  return fail(name +
              ": cannot be changed; write its tables with headers: [[region]], [[region.alarm]]");
}

}  // namespace

Result<std::string> changed_recipe(const std::string& text, const std::string& name,
                                   const RecipeChange& change) {
  auto before = parse_recipe(text, name);
  if (!before) return tl::unexpected(before.error());
  try {
    auto changed = edited(text, name, change, std::move(*before));
    return changed ? changed : fail(one_line(changed.error().message));
  } catch (const toml::parse_error& error) {
    return fail(name + ": a name is wrong: " + one_line(std::string(error.description())));
  }
}

}  // namespace orbwatch::app
