// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/daemon/daemon_program.h"
#include "tests/app/ports/web/http_client.h"
#include "tests/support/notify_socket.h"

/// Changes the configuration of `orbwatchd` over HTTP, like curl.
namespace orbwatch::tests {
namespace {

using app::web::tests::Answer;
using app::web::tests::request;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class ConfigurationOverHttp : public Daemon {
 protected:
  ConfigurationOverHttp() : manager(folder / "notify", std::chrono::seconds(10)) {
    ::setenv("STATE_DIRECTORY", folder.path().c_str(), 1);
    config = write_config(small_machine() +
                          "[web]\nenabled = true\nport = " + std::to_string(web_port) + "\n");
  }
  ~ConfigurationOverHttp() override { ::unsetenv("STATE_DIRECTORY"); }

  Answer ask(const std::string& what, const json& body) const {
    return request(web_port, "POST", "/api/v1/" + what + "_configuration",
                   "Content-Type: application/json\r\n", body.dump());
  }
  json shown() const { return json::parse(request(web_port, "GET", "/api/v1/configuration").body); }
  /// Text of the installed recipe with added comments.
  std::string other_recipe() const {
    return "# by hand \xC3\xA9\r\n" + kSmallRecipe + "# the end, without a line's";
  }
  json of_recipe(const std::string& text, int seconds = 60) const {
    return {{"files", {{"recipe.toml", text}}}, {"seconds", seconds}};
  }
  /// Starts a trial: the new recipe runs, and the files are unchanged.
  void begin_trial(int seconds) {
    manager.await("READY=1");
    old_checksum = read("system_configuration_checksum");
    const Answer tried = ask("try", of_recipe(other_recipe(), seconds));
    ASSERT_EQ(tried.status, 200) << tried.body;
    EXPECT_THAT(json::parse(tried.body)["difference"].get<std::string>(), HasSubstr("+# by hand"));
    manager.await("READY=1");
    EXPECT_NE(read("system_configuration_checksum"), old_checksum);
    EXPECT_EQ(contents(folder / "recipe.toml"), kSmallRecipe);
  }

  NotifySocket manager;
  const int web_port = free_port();
  std::string config;
  std::int64_t old_checksum = 0;
};

TEST_F(ConfigurationOverHttp, IsReadAsItIsOnTheDisk) {
  Subprocess daemon = start(config);
  manager.await("READY=1");
  std::map<std::string, std::string> texts;
  const json all = shown();
  for (const auto& file : all["files"]) {
    EXPECT_TRUE(file["may_change"]) << file["name"];
    texts[file["name"]] = file["text"];
  }
  for (const char* name : {"site.toml", "rig.toml", "recipe.toml"}) {
    EXPECT_EQ(texts[name], contents(folder / name)) << name;
  }
  EXPECT_EQ(texts.size(), 3U);
}

TEST_F(ConfigurationOverHttp, ShowsNoPrivateFile) {
  fs::permissions(folder / "recipe.toml", fs::perms(0600));
  Subprocess daemon = start(config);
  manager.await("READY=1");
  const json all = shown();
  for (const auto& file : all["files"]) {
    if (file["name"] != "recipe.toml") continue;
    EXPECT_FALSE(file["may_change"]);
    EXPECT_THAT(file["text"].get<std::string>(), HasSubstr("only its owner may read it"));
  }
  EXPECT_THAT(shown().dump(), Not(HasSubstr("hot_spot_threshold")));
  // A trial of another file must not change it either.
  const Answer tried =
      ask("try", {{"files", {{"rig.toml", kSmallRig + "# by hand\n"}}}, {"seconds", 60}});
  ASSERT_EQ(tried.status, 200) << tried.body;
  manager.await("READY=1");
  EXPECT_THAT(shown().dump(), Not(HasSubstr("hot_spot_threshold")));
  EXPECT_THAT(contents(folder / "trial-running.json"), Not(HasSubstr("hot_spot_threshold")));
}

/// The required role of a file is determined by its name.
TEST_F(ConfigurationOverHttp, KnowsAFileByOneNameOnly) {
  Subprocess daemon = start(config);
  manager.await("READY=1");
  const std::string folder_name = folder.path().filename();
  const std::vector<std::string> names{config, "./site.toml", "../" + folder_name + "/site.toml",
                                       "/" + folder_name, ""};
  for (const std::string& name : names) {
    const Answer refused = ask("try", {{"files", {{name, contents(config) + "# other\n"}}}});
    EXPECT_EQ(refused.status, 409) << name;
    EXPECT_THAT(refused.body,
                HasSubstr("must be a relative path inside the configuration's folder"))
        << name;
  }
  EXPECT_TRUE(shown()["trial"].is_null());
}

TEST_F(ConfigurationOverHttp, IsConfirmedByteForByte) {
  fs::permissions(folder / "recipe.toml", fs::perms(0640));
  Subprocess daemon = start(config);
  begin_trial(3600);
  json left;  // counted from the complete start, which READY may precede
  ASSERT_TRUE(eventually(daemon, [&] {
    left = shown()["trial"]["seconds_left"];
    return left.is_number();
  })) << shown();
  EXPECT_GT(left, 3500);
  EXPECT_LE(left, 3600);
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_trial_left") > 3500; }));
  EXPECT_LE(read("system_trial_left"), 3600);
  EXPECT_EQ(ask("try", of_recipe(kSmallRecipe)).status, 409) << "one at a time";

  const Answer confirmed = ask("confirm", json::object());
  ASSERT_EQ(confirmed.status, 200) << confirmed.body;
  EXPECT_THAT(json::parse(confirmed.body)["files"], ElementsAre("recipe.toml"));
  EXPECT_EQ(contents(folder / "recipe.toml"), other_recipe());
  EXPECT_EQ(fs::status(folder / "recipe.toml").permissions(), fs::perms(0640));
  EXPECT_TRUE(shown()["trial"].is_null());
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_trial_left") == 0; }));
  const auto checksum = read("system_configuration_checksum");
  daemon.send(SIGHUP);
  manager.await("READY=1");
  EXPECT_EQ(read("system_configuration_checksum"), checksum) << daemon.output();
}

/// Two editors, and one on the board.
TEST_F(ConfigurationOverHttp, RemovesNobodysChange) {
  Subprocess daemon = start(config);
  begin_trial(3600);
  const json read_before = shown();
  std::ofstream(folder / "rig.toml") << kSmallRig << "# by hand\n";
  const Answer refused = ask("confirm", json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_THAT(refused.body, HasSubstr("rig.toml was changed by "));
  EXPECT_THAT(contents(folder / "rig.toml"), HasSubstr("# by hand"));
  EXPECT_EQ(contents(folder / "recipe.toml"), kSmallRecipe) << "all or nothing";
  ASSERT_EQ(ask("revert", json::object()).status, 200);
  manager.await("READY=1");

  json second = of_recipe(other_recipe());
  const auto base_on = [&second](const json& read) {
    for (const auto& file : read["files"]) {
      second["based_on"][file["name"].get<std::string>()] = file["checksum"];
    }
  };
  base_on(read_before);
  const Answer outdated = ask("try", second);
  EXPECT_EQ(outdated.status, 409) << outdated.body;
  EXPECT_THAT(outdated.body, HasSubstr("rig.toml was changed by "));
  base_on(shown());
  EXPECT_EQ(ask("try", second).status, 200);
}

TEST_F(ConfigurationOverHttp, GoesBackWithoutConfirmation) {
  Subprocess daemon = start(config);
  begin_trial(10);
  manager.await("READY=1");
  EXPECT_EQ(read("system_configuration_checksum"), old_checksum);
  EXPECT_EQ(contents(folder / "recipe.toml"), kSmallRecipe);
  EXPECT_TRUE(shown()["trial"].is_null());
}

TEST_F(ConfigurationOverHttp, GoesBackWhenAsked) {
  Subprocess daemon = start(config);
  begin_trial(3600);
  EXPECT_EQ(ask("revert", json::object()).status, 200);
  manager.await("READY=1");
  EXPECT_EQ(read("system_configuration_checksum"), old_checksum);
}

/// Files change together or not at all, even if the power is cut between them.
TEST_F(ConfigurationOverHttp, ThatWasConfirmedIsWrittenToTheEndAfterAPowerCut) {
  {
    Subprocess daemon = start(config);
    begin_trial(3600);
    daemon.send(SIGKILL);
  }
  fs::rename(folder / "trial-running.json", folder / "trial-confirmed.json");
  Subprocess daemon = start(config);
  manager.await("READY=1");
  EXPECT_EQ(contents(folder / "recipe.toml"), other_recipe());
  EXPECT_NE(read("system_configuration_checksum"), old_checksum);
  EXPECT_FALSE(fs::exists(folder / "trial-confirmed.json"));
}

TEST_F(ConfigurationOverHttp, RefusesWhatIsWrongWithFileLineAndKey) {
  Subprocess daemon = start(config);
  manager.await("READY=1");
  const auto refusal = [&](const std::string& what, const json& files) {
    const Answer answer = ask(what, {{"files", files}});
    EXPECT_EQ(answer.status, 409) << answer.body;
    return json::parse(answer.body)["error"].get<std::string>();
  };
  for (const char* what : {"check", "try"}) {
    EXPECT_THAT(refusal(what, {{"recipe.toml", "nonsense = "}}), HasSubstr("recipe.toml:1"));
    EXPECT_THAT(refusal(what, {{"other.toml", "a = 1"}}),
                HasSubstr("no file of the configuration"));
    for (const char* name : {"../site.toml", "/etc/passwd", "", ".", "a/../recipe.toml",
                             "./recipe.toml", "recipe.toml/"}) {
      EXPECT_THAT(refusal(what, {{name, kSmallRecipe}}),
                  HasSubstr("relative path inside the configuration's folder"))
          << name;
    }
    EXPECT_THAT(refusal(what, json::object()), HasSubstr("no texts"));
  }
  EXPECT_THAT(refusal("try", {{"recipe.toml", kSmallRecipe}}), HasSubstr("change nothing"));
  EXPECT_FALSE(fs::exists(folder / "trial.json"));
}

/// A rig may name any file as a lens: a text in its place would reveal its contents, and replace
/// it.
TEST_F(ConfigurationOverHttp, TellsNothingOfFilesThatItDoesNotName) {
  const std::string lens =
      "image_width: 200\nimage_height: 200\n"
      "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [1143, 0, 99.5, 0, 1143, 99.5, 0, 0, 1]\n"
      "distortion_model: plumb_bob\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0, 0, 0, 0, 0]\n";
  std::ofstream(folder / "key.pem") << "the secret\n";
  Subprocess daemon = start(config);
  manager.await("READY=1");
  const auto begin = kSmallRig.find("fx ="), end = kSmallRig.find(kPlaces);
  const auto rig_with = [&](const std::string& file) {
    return std::string(kSmallRig).replace(begin, end - begin, "file = \"" + file + "\"\n");
  };
  for (const char* what : {"check", "try"}) {
    const Answer refused =
        ask(what, {{"files", {{"rig.toml", rig_with("key.pem")}, {"key.pem", lens}}}});
    EXPECT_EQ(refused.status, 409) << refused.body;
    EXPECT_THAT(refused.body, HasSubstr("key.pem: exists"));
    EXPECT_THAT(refused.body, Not(HasSubstr("the secret")));
  }
  const Answer taken =
      ask("check", {{"files", {{"rig.toml", rig_with("lens.yaml")}, {"lens.yaml", lens}}}});
  EXPECT_EQ(taken.status, 200) << taken.body;
  EXPECT_EQ(contents(folder / "key.pem"), "the secret\n");
}

/// Limits and regions of a recipe become lines of its file; the rest of the file is kept.
TEST_F(ConfigurationOverHttp, OfARecipeIsChangedWithinItsFile) {
  const std::string alarm =
      "[[region.alarm]]  # the weld\nsignal = \"hot_spot_pixels\"\nhigh_alarm = 400   # too hot\n";
  const std::string text = kSmallRecipe + alarm + "# the end";
  config = write_config(
      small_machine() + "[web]\nenabled = true\nport = " + std::to_string(web_port) + "\n",
      kSmallRig, text);
  Subprocess daemon = start(config);
  manager.await("READY=1");
  const json limit{{"alarm", 1},
                   {"region", "pool"},
                   {"signal", "hot_spot_pixels"},
                   {"limit", "high_alarm"},
                   {"value", 450}};
  const auto recipe = [&](const std::string& what, int number) {
    const json body{{"recipe", number}, {"limits", {limit}}};
    return request(web_port, "POST", "/api/v1/" + what + "_recipe",
                   "Content-Type: application/json\r\n", body.dump());
  };
  EXPECT_THAT(recipe("check", 2).body, HasSubstr("names no recipe 2"));
  const Answer tried = recipe("try", 1);
  ASSERT_EQ(tried.status, 200) << tried.body;
  manager.await("READY=1");
  const json runs = json::parse(request(web_port, "GET", "/api/v1/recipe").body);
  EXPECT_EQ(runs["alarms"][0]["high_alarm"], 450) << runs;
  ASSERT_EQ(ask("confirm", json::object()).status, 200);
  std::string expected = text;
  EXPECT_EQ(contents(folder / "recipe.toml"), expected.replace(expected.find("= 400"), 5, "= 450"));
}

/// There would be no configuration to return to.
TEST_F(ConfigurationOverHttp, IsNotTriedOutWithoutAServicesFolder) {
  ::unsetenv("STATE_DIRECTORY");
  Subprocess daemon = start(config);
  manager.await("READY=1");
  EXPECT_EQ(ask("check", of_recipe(other_recipe())).status, 200);
  for (const std::string what : {"try", "confirm", "revert"}) {
    const Answer answer = ask(what, what == "try" ? of_recipe(other_recipe()) : json::object());
    EXPECT_EQ(answer.status, 409) << what;
    EXPECT_THAT(answer.body, HasSubstr("without STATE_DIRECTORY")) << what;
  }
  EXPECT_EQ(contents(folder / "recipe.toml"), kSmallRecipe);
}

}  // namespace
}  // namespace orbwatch::tests
