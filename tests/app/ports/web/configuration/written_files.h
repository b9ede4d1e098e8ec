// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/model/configuration/configuration_files.h"

namespace orbwatch::app::web::tests {

/// Files of a configuration in memory, with a record of requests. The checksum of a text is the
/// text.
class WrittenFiles final : public ConfigurationFiles {
 public:
  Result<State> read() const override {
    const std::lock_guard lock(mutex);
    State now = state;
    for (const auto& [name, text] : now.files) {
      if (!now.versions.contains(name)) now.versions[name] = {text, "2020-11-21T20:57:46Z", "root"};
    }
    return now;
  }
  /// Appends a line for each change to the rig's text.
  Result<Edit> with_changed_recipe(int number, const RecipeChange& change) const override {
    const std::lock_guard lock(mutex);
    if (number != 1) return fail("there is no recipe " + std::to_string(number));
    std::string text = state.files.at("rig.toml");
    for (const LimitChange& limit : change.limits) {
      text += limit.region + " " + limit.signal + " " + std::to_string(limit.alarm) + " " +
              limit.limit + (limit.value ? " " + std::to_string(*limit.value) : "") + "\n";
    }
    for (const RegionChange& region : change.regions) {
      text += region.name + " " + std::to_string(region.points.size()) + "\n";
    }
    if (change.copy) {
      const std::string& site = state.files.at("site.toml");
      return Edit{{{change.copy->name, text}, {"site.toml", site + change.copy->name + "\n"}},
                  {{"site.toml", site}}};
    }
    return Edit{{{"rig.toml", text}}, {{"rig.toml", state.files.at("rig.toml")}}};
  }
  Result<Change> check(const Texts& texts) const override {
    const std::lock_guard lock(mutex);
    return change_of(texts);
  }
  Result<Change> try_out(const Edit& edit, int seconds) override {
    const std::lock_guard lock(mutex);
    auto change = change_of(edit.texts);
    if (change) {
      state.trial = edit.texts;
      state.seconds_left = seconds;
      state.owner = edit.owner;
    }
    return change;
  }
  Result<std::vector<std::string>> confirm() override {
    const std::lock_guard lock(mutex);
    if (!state.trial) return fail("none waits");
    std::vector<std::string> names;
    const Texts texts = *std::exchange(state.trial, std::nullopt);
    for (const auto& [name, text] : texts) {
      state.files[name] = text;
      names.push_back(name);
    }
    return names;
  }
  Result<> revert() override {
    const std::lock_guard lock(mutex);
    if (!std::exchange(state.trial, std::nullopt)) return fail("none waits");
    return {};
  }

  mutable std::mutex mutex;
  State state{"site.toml", {{"site.toml", "# mine\n"}, {"rig.toml", "a = 1\n"}}, {}, "", {}, {},
              {}};

 private:
  Result<Change> change_of(const Texts& texts) const {
    Change change;
    for (const auto& [name, text] : texts) {
      if (text == "wrong") return fail(name + ":1: nonsense");
      change.files.push_back(name);
      change.difference += "+" + text;
    }
    return change;
  }
};

}  // namespace orbwatch::app::web::tests
