// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/configuration/configuration_desk.h"

#include <map>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "app/ports/web/api/typed_route.h"

namespace orbwatch::app::web {
namespace {

/// Entries of the audit among which the last change of a file is searched.
constexpr std::size_t kMostSearched = 1000;

/// Stands for absent files; refuses everything.
class NoFiles final : public ConfigurationFiles {
 public:
  Result<State> read() const override { return refusal(); }
  Result<Edit> with_changed_recipe(int, const RecipeChange&) const override { return refusal(); }
  Result<Change> check(const Texts&) const override { return refusal(); }
  Result<Change> try_out(const Edit&, int) override { return refusal(); }
  Result<std::vector<std::string>> confirm() override { return refusal(); }
  Result<> revert() override { return refusal(); }

 private:
  static tl::unexpected<Error> refusal() { return fail("there are no configuration files"); }
};

Response conflict(const Error& error) { return error_response(409, error.message); }

/// Checks for UTF-8, because a text that JSON would change must not be sent back.
bool is_utf8(const std::string& text) {
  try {
    return !Json(text).dump().empty();
  } catch (const Json::type_error&) {
    return false;
  }
}

void add(std::vector<FileAnswer>& list, const ConfigurationFiles::Texts& texts,
         const std::map<std::string, ConfigurationFiles::Version>& versions, bool may_change) {
  for (const auto& [name, text] : texts) {
    FileAnswer& file = list.emplace_back(FileAnswer{name, may_change && is_utf8(text), text, {}});
    if (const auto version = versions.find(name); version != versions.end()) {
      file.checksum = version->second.checksum;
    }
  }
}

/// Returns whether the configuration file itself is changed.
bool is_other_site(const ConfigurationFiles::State& state, const ConfigurationFiles::Texts& texts) {
  const auto changed = texts.find(state.site), present = state.files.find(state.site);
  return changed != texts.end() &&
         (present == state.files.end() || present->second != changed->second);
}

/// Lines of one side of a difference, "-" or "+", and lines without a side.
std::string side_of(const std::string& difference, char side) {
  const char other = side == '+' ? '-' : '+';
  std::istringstream in(difference);
  std::string text;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(other)) continue;
    text += line.substr(line.starts_with(side) ? 1 : 0) + "\n";
  }
  return text;
}

/// Compares two moments in ISO 8601, to the second.
bool is_before(std::string_view moment, std::string_view other) {
  constexpr std::size_t kToTheSecond = std::string_view("2026-11-21T20:57:46").size();
  return moment.substr(0, kToTheSecond) < other.substr(0, kToTheSecond);
}

}  // namespace

ConfigurationDesk::ConfigurationDesk(std::shared_ptr<ConfigurationFiles> files, const Audit& audit,
                                     Changes& changes)
    : files_(files ? std::move(files) : std::make_shared<NoFiles>()),
      audit_(audit),
      changes_(changes) {}

void ConfigurationDesk::show(const ExchangePtr& exchange) {
  changes_.read(exchange, [this] { return response_of(read()); });
}

Answered<ConfigurationAnswer> ConfigurationDesk::read() const {
  const auto state = files_->read();
  if (!state) return refuse(state.error());
  ConfigurationAnswer answer{state->site, {}, state->refusal, {}};
  add(answer.files, state->files, state->versions, true);
  add(answer.files, state->outside, {}, false);
  if (state->trial) answer.trial = {*state->trial, state->seconds_left, state->owner};
  return answer;
}

/// Returns the texts that a caller sent if the caller has the right to them.
Answered<ConfigurationFiles::Edit> ConfigurationDesk::permitted(const ChangeRequest& change,
                                                                const Edit& edit) const {
  if (change.caller.role >= Role::Administrator) return edit;
  const auto state = files_->read();
  if (!state) return refuse(state.error());
  if (is_other_site(*state, edit.texts)) {
    return refuse(403, "another " + state->site +
                           " needs the role administrator: it determines where users are kept and "
                           "which camera modules run");
  }
  return edit;
}

/// Returns the edit if it would not overwrite another change.
Answered<ConfigurationFiles::Edit> ConfigurationDesk::based(const Edit& edit) const {
  if (edit.based_on.empty()) return edit;
  const auto state = files_->read();
  if (!state) return refuse(state.error());
  const auto checked = check_basis(*state, edit);
  if (!checked) return refuse(checked.error());
  return edit;
}

/// User of the newest confirmation on the page that wrote the file since its change began;
/// otherwise the account on the board.
std::string ConfigurationDesk::changer_of(const std::string& name,
                                          const ConfigurationFiles::Version& now) const {
  std::string who;
  for (const Json& entry : audit_.newest(kMostSearched)) {
    if (entry.value("what", "") != "confirm_configuration" || entry.value("result", "") != "done" ||
        is_before(entry.value("time", ""), now.time)) {
      continue;
    }
    std::istringstream files(entry.value("after", ""));
    for (std::string file; std::getline(files >> std::ws, file, ',');) {
      if (file == name) who = entry.value("who", "");
    }
  }
  return who.empty() ? now.account + " (account on the board)" : who;
}

/// Error: a file differs from the version on which the new texts are based, so that their change
/// would overwrite another.
Result<> ConfigurationDesk::check_basis(const ConfigurationFiles::State& state,
                                        const Edit& edit) const {
  for (const auto& [name, checksum] : edit.based_on) {
    const auto version = state.versions.find(name);
    if (version == state.versions.end()) return fail(name + " was removed since it was read");
    const ConfigurationFiles::Version& now = version->second;
    if (now.checksum == checksum) continue;
    return fail(
        name + " was changed by " + changer_of(name, now) + " at " + now.time +
        ", after it was read for this change, which would overwrite that one; read it again");
  }
  return {};
}

Answered<ConfigurationFiles::Change> ConfigurationDesk::check_edit(
    ChangeRequest& change, const Answered<Edit>& edit) const {
  change.changes_nothing = true;
  return edit.and_then([&](const Edit& sent) { return based(sent); })
      .and_then([&](const Edit& sent) { return files_->check(sent.texts).map_error(conflict); });
}

Answered<TrialAnswer> ConfigurationDesk::try_edit(ChangeRequest& change, const Answered<Edit>& edit,
                                                  int seconds) {
  return edit.and_then([&](const Edit& sent) { return based(sent); })
      .and_then([&](Edit sent) {
        sent.owner = change.caller.name;
        return files_->try_out(sent, seconds).map_error(conflict);
      })
      .map([&](const ConfigurationFiles::Change& tried) {
        change.before = side_of(tried.difference, '-');
        change.after = side_of(tried.difference, '+');
        return TrialAnswer{tried, seconds};
      });
}

/// The text that results from changes of a recipe.
Answered<ConfigurationFiles::Edit> ConfigurationDesk::edit_of(const RecipeBody& body) const {
  return files_->with_changed_recipe(body.recipe, body.change).map_error(conflict);
}

Answered<ConfigurationFiles::Change> ConfigurationDesk::check(Change<ConfigurationBody>& change) {
  return check_edit(change, permitted(change, change.body.edit));
}

Answered<TrialAnswer> ConfigurationDesk::try_out(Change<ConfigurationBody>& change) {
  return try_edit(change, permitted(change, change.body.edit), change.body.seconds);
}

Answered<ConfigurationFiles::Change> ConfigurationDesk::check_recipe(Change<RecipeBody>& change) {
  return check_edit(change, edit_of(change.body));
}

Answered<TrialAnswer> ConfigurationDesk::try_recipe(Change<RecipeBody>& change) {
  return try_edit(change, edit_of(change.body), change.body.seconds);
}

Answered<ConfirmedAnswer> ConfigurationDesk::confirm(Change<Nothing>& change) {
  const auto written = files_->confirm();
  if (!written) return refuse(written.error());
  for (const std::string& name : *written) {
    change.after += (change.after.empty() ? "" : ", ") + name;
  }
  return ConfirmedAnswer{*written};
}

Answered<Done> ConfigurationDesk::revert(Change<Nothing>& /*change*/) {
  return files_->revert().map([] { return Done{}; }).map_error(conflict);
}

}  // namespace orbwatch::app::web
