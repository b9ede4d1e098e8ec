// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/configuration/recipe_body.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/ports/web/configuration/configuration_body.h"

namespace orbwatch::app::web {
namespace {

using nlohmann::json;

constexpr const char* kRecipeForm =
    R"(the body must be {"recipe": 1, "limits": [{"alarm": 1, "region": "NAME", "signal": "NAME", )"
    R"("limit": "NAME", "value": 1.5}, ...], "regions": [{"name": "NAME", "points": [[X, Y, Z], )"
    R"(...]}, ...], "seconds": 60})";

tl::unexpected<Error> wrong(const std::string& what) { return fail(what + ": " + kRecipeForm); }

/// Returns whether `object` is an object whose members are among these.
bool is_of(const json& object, std::initializer_list<std::string_view> names) {
  return object.is_object() && std::ranges::all_of(object.items(), [&](const auto& item) {
           return std::ranges::find(names, std::string_view(item.key())) != names.end();
         });
}

bool has_text(const json& object, const char* name) {
  return object.contains(name) && object[name].is_string();
}

bool has_number(const json& object, const char* name) {
  return object.contains(name) && object[name].is_number();
}

/// Returns whether a member is a whole number from 0 on.
bool has_count(const json& object, const char* name) {
  return object.contains(name) && object[name].is_number_unsigned();
}

Result<LimitChange> limit_of(const json& sent) {
  const bool is_right =
      is_of(sent, {"alarm", "region", "signal", "limit", "value"}) && has_count(sent, "alarm") &&
      has_text(sent, "region") && has_text(sent, "signal") && has_text(sent, "limit") &&
      (has_number(sent, "value") || (sent.contains("value") && sent["value"].is_null()));
  if (!is_right) return wrong("a limit is malformed");
  LimitChange change{sent["alarm"].get<std::size_t>(), sent["region"].get<std::string>(),
                     sent["signal"].get<std::string>(), sent["limit"].get<std::string>()};
  if (sent["value"].is_number()) change.value = sent["value"].get<double>();
  return change;
}

template <std::size_t N>
Result<> read_corners(const json& region, const char* name,
                      std::vector<std::array<double, N>>& corners) {
  const auto sent = region.find(name);
  if (sent == region.end()) return {};
  if (!sent->is_array()) return wrong(std::string(name) + " is not a list");
  for (const json& corner : *sent) {
    const bool is_right = corner.is_array() && corner.size() == N &&
                          std::ranges::all_of(corner, [](const json& n) { return n.is_number(); });
    if (!is_right) {
      return wrong("a corner of " + std::string(name) + " is not a list of " + std::to_string(N) +
                   " numbers");
    }
    for (std::size_t i = 0; i < N; ++i) {
      (i == 0 ? corners.emplace_back() : corners.back())[i] = corner[i].get<double>();
    }
  }
  return {};
}

Result<RegionChange> region_of(const json& sent) {
  if (is_of(sent, {"name", "removed"}) && sent.contains("removed")) {
    if (!has_text(sent, "name") || sent["removed"] != true) {
      return wrong("a region is malformed");
    }
    RegionChange change{sent["name"].get<std::string>()};
    change.is_removed = true;
    return change;
  }
  const bool is_right =
      is_of(sent, {"name", "directions", "points", "view", "hot_spot_threshold"}) &&
      has_text(sent, "name") && sent.contains("view") == sent.contains("hot_spot_threshold");
  if (!is_right) return wrong("a region is malformed");
  RegionChange change{sent["name"].get<std::string>()};
  if (sent.contains("view")) {
    if (!has_text(sent, "view") || !has_number(sent, "hot_spot_threshold")) {
      return wrong("a region is malformed");
    }
    change.added = {sent["view"].get<std::string>(), sent["hot_spot_threshold"].get<double>()};
  }
  return read_corners(sent, "directions", change.directions)
      .and_then([&] { return read_corners(sent, "points", change.points); })
      .map([&] { return change; });
}

template <class Change>
Result<> read_list(const json& sent, std::string_view name,
                   Result<Change> (*change_of)(const json&), std::vector<Change>& changes) {
  const auto list = sent.find(name);
  if (list == sent.end()) return {};
  if (!list->is_array()) return wrong(std::string(name) + " is not a list");
  for (const json& one : *list) {
    auto change = change_of(one);
    if (!change) return tl::unexpected(change.error());
    changes.push_back(std::move(*change));
  }
  return {};
}

}  // namespace

Result<RecipeBody> parse_recipe_change(std::string_view body) {
  const auto sent = json::parse(body, nullptr, false);
  const bool is_right =
      is_of(sent,
            {kRecipeMember.name, kLimitsMember.name, kRegionsMember.name, kSecondsMember.name}) &&
      has_count(sent, "recipe") && sent["recipe"] <= std::numeric_limits<std::uint16_t>::max();
  if (!is_right) return wrong("the body has no changes of a recipe");
  RecipeBody parsed;
  parsed.recipe = sent["recipe"].get<int>();
  const auto seconds = seconds_of(sent);
  if (!seconds) return tl::unexpected(seconds.error());
  parsed.seconds = *seconds;
  return read_list(sent, kLimitsMember.name, limit_of, parsed.change.limits)
      .and_then(
          [&] { return read_list(sent, kRegionsMember.name, region_of, parsed.change.regions); })
      .map([&] { return std::move(parsed); });
}

}  // namespace orbwatch::app::web
