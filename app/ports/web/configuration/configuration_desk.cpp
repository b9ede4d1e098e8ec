// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/configuration/configuration_desk.h"

#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <utility>

#include "app/ports/web/configuration/configuration_body.h"
#include "app/ports/web/configuration/recipe_body.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

/// Longest diff stored in the audit, in bytes.
constexpr std::size_t kMostNoted = 4096;
/// Entries of the audit among which the last change of a file is searched.
constexpr std::size_t kMostSearched = 1000;

/// Writes JSON, in which invalid UTF-8 is replaced.
Response answer(const Json& json) {
  return json_response(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// Checks for UTF-8, because a text that JSON would change must not be sent back.
bool is_utf8(const std::string& text) {
  try {
    return !Json(text).dump().empty();
  } catch (const Json::type_error&) {
    return false;
  }
}

Json change_json(const ConfigurationFiles::Change& change) {
  return {{"files", change.files}, {"difference", change.difference}};
}

void add(Json& list, const ConfigurationFiles::Texts& texts,
         const std::map<std::string, ConfigurationFiles::Version>& versions, bool may_change) {
  for (const auto& [name, text] : texts) {
    Json file{{"name", name}, {"may_change", may_change && is_utf8(text)}, {"text", text}};
    if (const auto version = versions.find(name); version != versions.end()) {
      file["checksum"] = version->second.checksum;
    }
    list.push_back(std::move(file));
  }
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
  return text.substr(0, kMostNoted);
}

/// Compares two moments in ISO 8601, to the second.
bool is_before(std::string_view moment, std::string_view other) {
  constexpr std::size_t kToTheSecond = std::string_view("2026-11-21T20:57:46").size();
  return moment.substr(0, kToTheSecond) < other.substr(0, kToTheSecond);
}

}  // namespace

/// A request for a change, with its values for the audit.
struct ConfigurationDesk::Sent {
  Caller caller;
  ConfigurationBody body{};
  RecipeBody recipe{};
  std::string before{};
  std::string after{};

  static Result<> read_nothing(std::string_view /*body*/, Sent& /*sent*/) { return {}; }
  static Result<> read_files(std::string_view text, Sent& sent) {
    return parse_configuration(text).map(
        [&](ConfigurationBody parsed) { sent.body = std::move(parsed); });
  }
  static Result<> read_recipe(std::string_view text, Sent& sent) {
    return parse_recipe_change(text).map(
        [&](RecipeBody parsed) { sent.recipe = std::move(parsed); });
  }
};

ConfigurationDesk::ConfigurationDesk(std::shared_ptr<ConfigurationFiles> files, Access& access,
                                     Audit& audit)
    : files_(std::move(files)), access_(access), audit_(audit) {}

std::vector<Route> ConfigurationDesk::routes() {
  if (!files_) return {};
  std::vector<Route> routes;
  routes.push_back(
      {"GET", "/api/v1/configuration", Role::Integrator,
       "Returns the configuration files on the disk, and the running configuration if it differs",
       std::string(kJson), [this](const ExchangePtr& exchange) {
         work_.run(exchange, asker(exchange), [this] { return show(); });
       }});
  routes.push_back(changing(
      "/api/v1/check_configuration",
      "Checks the configuration with these texts in place of some files, and returns their changes",
      {kFilesMember, kBasedOnMember}, &Sent::read_files, &ConfigurationDesk::check));
  routes.push_back(changing("/api/v1/try_configuration",
                            "Checks the configuration like check_configuration, and runs it on "
                            "trial until it is confirmed or reverted",
                            {kFilesMember, kBasedOnMember, kSecondsMember}, &Sent::read_files,
                            &ConfigurationDesk::try_out));
  routes.push_back(changing("/api/v1/check_recipe",
                            "Checks the configuration with these limits and regions in a recipe's "
                            "file, which is otherwise unchanged, and returns the changes",
                            {kRecipeMember, kLimitsMember, kRegionsMember}, &Sent::read_recipe,
                            &ConfigurationDesk::check_recipe));
  routes.push_back(changing("/api/v1/try_recipe",
                            "Checks the recipe like check_recipe, and runs it on trial until it is "
                            "confirmed or reverted, like try_configuration",
                            {kRecipeMember, kLimitsMember, kRegionsMember, kSecondsMember},
                            &Sent::read_recipe, &ConfigurationDesk::try_recipe));
  routes.push_back(changing("/api/v1/confirm_configuration",
                            "Confirms the configuration on trial: writes its files", {},
                            &Sent::read_nothing, &ConfigurationDesk::confirm));
  routes.push_back(changing("/api/v1/revert_configuration", "Reverts the configuration on trial",
                            {}, &Sent::read_nothing, &ConfigurationDesk::revert));
  return routes;
}

Route ConfigurationDesk::changing(const char* path, const char* description,
                                  std::vector<BodyMember> body, Read read, Handler handler) {
  Route route{"POST", path, Role::Integrator, description, std::string(kJson), {}};
  route.body = std::move(body);
  route.serve = [this, read, handler](const ExchangePtr& exchange) {
    work_.run(exchange, asker(exchange),
              [this, read, handler, exchange] { return answer_and_note(exchange, read, handler); });
  };
  return route;
}

/// Client in the queues; every caller here has a role.
SlowWork::Asker ConfigurationDesk::asker(const ExchangePtr& exchange) const {
  return {true, access_.caller(credentials_of(exchange->request())).name};
}

Response ConfigurationDesk::answer_and_note(const ExchangePtr& exchange, Read read,
                                            Handler handler) {
  const web::Request& request = exchange->request();
  Sent sent{access_.caller(credentials_of(request))};
  if (sent.caller.role < Role::Integrator) {
    return error_response(401, "the required role has expired; log in again");
  }
  const std::string name = request.path.substr(request.path.rfind('/') + 1);
  if (const auto right = read(request.body, sent); !right) {
    return error_response(400, right.error().message);
  }
  Response response = (this->*handler)(sent);
  if (handler != &ConfigurationDesk::check && handler != &ConfigurationDesk::check_recipe) {
    constexpr int kDone = 200;
    audit_.note({std::chrono::system_clock::now(), sent.caller.name, client_address(request), name,
                 sent.before, sent.after, response.status == kDone ? "done" : "refused"});
  }
  return response;
}

Response ConfigurationDesk::show() const {
  const auto state = files_->read();
  if (!state) return error_response(409, state.error().message);
  Json list = Json::array();
  add(list, state->files, state->versions, true);
  add(list, state->outside, {}, false);
  Json trial;
  if (state->trial) {
    trial = {{"files", *state->trial},
             {"seconds_left", state->seconds_left ? Json(*state->seconds_left) : Json()}};
  }
  return answer({{"site", state->site},
                 {"files", std::move(list)},
                 {"refusal", state->refusal},
                 {"trial", std::move(trial)}});
}

/// Checks the rights. Error: the configuration file itself is changed, which requires an
/// administrator.
Result<> ConfigurationDesk::permit(const Sent& sent) const {
  if (sent.caller.role >= Role::Administrator) return {};
  const auto state = files_->read();
  if (!state) return tl::unexpected(state.error());
  const auto changed = sent.body.edit.texts.find(state->site);
  const auto present = state->files.find(state->site);
  const bool is_other = changed != sent.body.edit.texts.end() &&
                        (present == state->files.end() || present->second != changed->second);
  if (!is_other) return {};
  return fail("another " + state->site +
              " needs the role administrator: it determines where users are kept and which camera "
              "modules run");
}

/// User of the newest confirmation on the page that wrote the file since its change began;
/// otherwise the account on the board.
std::string ConfigurationDesk::changer_of(const std::string& name,
                                          const ConfigurationFiles::Version& now) const {
  const Json audit = Json::parse(audit_.newest(kMostSearched), nullptr, false);
  std::string who;
  for (const Json& entry : audit.value("entries", Json::array())) {
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
Result<> ConfigurationDesk::check_basis(const Sent& sent) const {
  if (sent.body.edit.based_on.empty()) return {};
  const auto state = files_->read();
  if (!state) return tl::unexpected(state.error());
  for (const auto& [name, checksum] : sent.body.edit.based_on) {
    const auto version = state->versions.find(name);
    if (version == state->versions.end()) return fail(name + " was removed since it was read");
    const ConfigurationFiles::Version& now = version->second;
    if (now.checksum == checksum) continue;
    return fail(
        name + " was changed by " + changer_of(name, now) + " at " + now.time +
        ", after it was read for this change, which would overwrite that one; read it again");
  }
  return {};
}

Response ConfigurationDesk::check(Sent& sent) {
  if (const auto permitted = permit(sent); !permitted) {
    return error_response(403, permitted.error().message);
  }
  if (const auto unchanged = check_basis(sent); !unchanged) {
    return error_response(409, unchanged.error().message);
  }
  const auto change = files_->check(sent.body.edit.texts);
  return change ? answer(change_json(*change)) : error_response(409, change.error().message);
}

Response ConfigurationDesk::try_out(Sent& sent) {
  if (const auto permitted = permit(sent); !permitted) {
    return error_response(403, permitted.error().message);
  }
  if (const auto unchanged = check_basis(sent); !unchanged) {
    return error_response(409, unchanged.error().message);
  }
  const auto change = files_->try_out(sent.body.edit, sent.body.seconds);
  if (!change) return error_response(409, change.error().message);
  sent.before = side_of(change->difference, '-');
  sent.after = side_of(change->difference, '+');
  Json json = change_json(*change);
  json["seconds"] = sent.body.seconds;
  return answer(json);
}

/// Replaces the sent changes by the text that results from them.
Result<> ConfigurationDesk::apply_changes(Sent& sent) const {
  return files_->with_changed_recipe(sent.recipe.recipe, sent.recipe.change)
      .map([&](ConfigurationFiles::Edit edit) {
        sent.body = {std::move(edit), sent.recipe.seconds};
      });
}

Response ConfigurationDesk::check_recipe(Sent& sent) {
  const auto applied = apply_changes(sent);
  return applied ? check(sent) : error_response(409, applied.error().message);
}

Response ConfigurationDesk::try_recipe(Sent& sent) {
  const auto applied = apply_changes(sent);
  return applied ? try_out(sent) : error_response(409, applied.error().message);
}

Response ConfigurationDesk::confirm(Sent& sent) {
  const auto written = files_->confirm();
  if (!written) return error_response(409, written.error().message);
  for (const std::string& name : *written) sent.after += (sent.after.empty() ? "" : ", ") + name;
  return answer({{"files", *written}});
}

Response ConfigurationDesk::revert(Sent& /*sent*/) {
  const auto reverted = files_->revert();
  if (!reverted) return error_response(409, reverted.error().message);
  return answer({{"result_text", "done"}});
}

}  // namespace orbwatch::app::web
