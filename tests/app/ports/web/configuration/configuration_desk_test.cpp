// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/configuration/configuration_desk.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/app/ports/web/access/access_served.h"
#include "tests/app/ports/web/configuration/written_files.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

class Configuration : public AccessServed {
 protected:
  void SetUp() override {
    AccessServed::SetUp();
    program.files = written;
    add_one_of_each_role();
  }
  Answer ask(const std::string& what, const json& body, Role role = Role::Integrator) const {
    return post("/api/v1/" + what + "_configuration", body.dump(), by_token(role) + kJsonHeader);
  }
  json shown() const {
    return json::parse(get(port(), "/api/v1/configuration", by_token(Role::Integrator)).body);
  }
  static std::string text_of(const json& configuration, const std::string& name) {
    for (const auto& file : configuration["files"]) {
      if (file["name"] == name) return file["text"];
    }
    return "there is no " + name;
  }

  const std::shared_ptr<WrittenFiles> written = std::make_shared<WrittenFiles>();
};

TEST_F(Configuration, IsReadByteForByte) {
  const std::string text =
      "# \xC3\xA9 \"quoted\"\\\r\n\tz = 1\n\n\na = 2  # last, without a line's end";
  written->state.files["rig.toml"] = text;
  written->state.outside["/srv/lens.yaml"] = "k1: \xFF";
  start();
  const json all = shown();
  EXPECT_EQ(all["site"], "site.toml");
  EXPECT_EQ(text_of(all, "rig.toml"), text);
  EXPECT_EQ(all["refusal"], "");
  EXPECT_TRUE(all["trial"].is_null());
  for (const auto& file : all["files"]) {
    EXPECT_EQ(file["may_change"], file["name"] != "/srv/lens.yaml") << file["name"];
  }
}

TEST_F(Configuration, ThatIsNoUtf8IsNotToBeSentBack) {
  written->state.files["rig.toml"] = "# \xFF";
  start();
  EXPECT_FALSE(shown()["files"][0]["may_change"]) << shown();
}

TEST_F(Configuration, IsTriedOutAndConfirmed) {
  start();
  const std::string text = "# kept\r\nb = 2\n";
  const json body{{"files", {{"rig.toml", text}}}, {"seconds", 30}};
  const json checked = json::parse(ask("check", {{"files", {{"rig.toml", text}}}}).body);
  EXPECT_THAT(checked["files"], ElementsAre("rig.toml"));
  EXPECT_EQ(checked["difference"], "+" + text);
  EXPECT_TRUE(shown()["trial"].is_null()) << "a check changes nothing";

  const Answer tried = ask("try", body);
  ASSERT_EQ(tried.status, 200) << tried.body;
  EXPECT_EQ(json::parse(tried.body)["seconds"], 30);
  EXPECT_EQ(shown()["trial"]["files"]["rig.toml"], text);
  EXPECT_EQ(shown()["trial"]["seconds_left"], 30);
  EXPECT_EQ(shown()["trial"]["owner"], "integrator");
  EXPECT_EQ(text_of(shown(), "rig.toml"), "a = 1\n");

  EXPECT_THAT(json::parse(ask("confirm", json::object()).body)["files"], ElementsAre("rig.toml"));
  EXPECT_EQ(text_of(shown(), "rig.toml"), text);
  EXPECT_EQ(ask("confirm", json::object()).status, 409);
  EXPECT_EQ(ask("revert", json::object()).status, 409);
}

TEST_F(Configuration, GoesBackWhenAsked) {
  start();
  ASSERT_EQ(ask("try", {{"files", {{"rig.toml", "b = 2"}}}}).status, 200);
  EXPECT_EQ(ask("revert", json::object()).status, 200);
  EXPECT_TRUE(shown()["trial"].is_null());
  EXPECT_EQ(text_of(shown(), "rig.toml"), "a = 1\n");
}

TEST_F(Configuration, ThatIsWrongIsRefusedWithItsLine) {
  start();
  for (const char* what : {"check", "try"}) {
    const Answer answer = ask(what, {{"files", {{"rig.toml", "wrong"}}}});
    EXPECT_EQ(answer.status, 409);
    EXPECT_EQ(json::parse(answer.body)["error"], "rig.toml:1: nonsense");
    EXPECT_EQ(ask(what, {{"files", 1}}).status, 400);
  }
  EXPECT_TRUE(shown()["trial"].is_null());
}

/// Another site file could change or remove the users.
TEST_F(Configuration, OfTheSiteIsTheAdministrators) {
  start();
  const json other{{"files", {{"site.toml", "state_folder = \"/tmp\"\n"}}}};
  const json same{{"files", {{"site.toml", "# mine\n"}, {"rig.toml", "b = 2"}}}};
  for (const char* what : {"check", "try"}) {
    const Answer refused = ask(what, other);
    EXPECT_EQ(refused.status, 403);
    EXPECT_THAT(refused.body, HasSubstr("another site.toml needs the role administrator"));
  }
  EXPECT_TRUE(shown()["trial"].is_null());
  EXPECT_EQ(ask("try", same).status, 200) << "unchanged";
  EXPECT_EQ(ask("revert", json::object()).status, 200);
  EXPECT_EQ(ask("try", other, Role::Administrator).status, 200);
}

/// The appliance itself makes the text of the site, which only names one more recipe.
TEST_F(Configuration, OfACopiedRecipeIsAnIntegratorsAlthoughTheSiteNamesIt) {
  start();
  const json body{{"recipe", 1}, {"copy", {{"number", 2}, {"name", "thin"}}}};
  const auto recipe = [&](const json& sent) {
    return post("/api/v1/try_recipe", sent.dump(), by_token(Role::Integrator) + kJsonHeader);
  };
  EXPECT_EQ(recipe({{"recipe", 1}, {"copy", {{"name", "thin"}}}}).status, 400) << "no number";
  ASSERT_EQ(recipe(body).status, 200);
  EXPECT_EQ(shown()["trial"]["files"],
            json({{"thin", "a = 1\n"}, {"site.toml", "# mine\nthin\n"}}));
}

/// Otherwise a change by a second editor, or at the board, would be lost.
TEST_F(Configuration, MadeOfAnOlderFileIsRefusedWithWhoChangedItAndWhen) {
  start();
  const auto based_on = [](const std::string& checksum) {
    return json{{"files", {{"rig.toml", "c = 3\n"}}}, {"based_on", {{"rig.toml", checksum}}}};
  };
  EXPECT_EQ(shown()["files"][0]["checksum"], "a = 1\n");
  EXPECT_EQ(ask("check", based_on("a = 1\n")).status, 200);
  for (const char* what : {"check", "try"}) {
    const Answer refused = ask(what, based_on("a = 0\n"));
    EXPECT_EQ(refused.status, 409);
    EXPECT_THAT(json::parse(refused.body)["error"].get<std::string>(),
                HasSubstr("rig.toml was changed by root (account on the board) at "
                          "2020-11-21T20:57:46Z"));
  }
  ASSERT_EQ(ask("try", {{"files", {{"rig.toml", "b = 2\n"}}}}).status, 200);
  ASSERT_EQ(ask("confirm", json::object()).status, 200);
  EXPECT_THAT(ask("try", based_on("a = 1\n")).body,
              HasSubstr("rig.toml was changed by integrator at"));
  EXPECT_TRUE(shown()["trial"].is_null());
  EXPECT_EQ(ask("try", based_on("b = 2\n")).status, 200);
}

TEST_F(Configuration, ThatIsTooLargeIsRefused) {
  WebSettings settings;
  settings.max_body_bytes = 1024;
  start(settings);
  const Answer answer = ask("try", {{"files", {{"rig.toml", std::string(2000, '#')}}}});
  EXPECT_EQ(answer.status, 413) << answer.body;
  EXPECT_TRUE(shown()["trial"].is_null());
}

TEST_F(Configuration, IsNotedInTheAudit) {
  start();
  ask("try", {{"files", {{"rig.toml", "b = 2"}}}});
  ask("confirm", json::object());
  ask("confirm", json::object());
  const json audit = json::parse(get(port(), "/api/v1/audit", by_token(Role::Administrator)).body);
  const json& entries = audit["entries"];
  ASSERT_EQ(entries.size(), 3U) << audit;
  EXPECT_EQ(entries[0]["what"], "try_configuration");
  EXPECT_EQ(entries[0]["who"], "integrator");
  EXPECT_EQ(entries[0]["after"], "b = 2\n");
  EXPECT_EQ(entries[1]["after"], "rig.toml");
  EXPECT_EQ(entries[2]["result"], "refused");
}

TEST_F(Configuration, ThatIsLongIsNotedByItsBegin) {
  start();
  std::string text = "#";
  for (int i = 0; i < 3000; ++i) text += "\u00e4";
  ASSERT_EQ(ask("try", {{"files", {{"rig.toml", text}}}}).status, 200);
  const json audit = json::parse(get(port(), "/api/v1/audit", by_token(Role::Administrator)).body);
  EXPECT_EQ(audit["entries"][0]["after"], text.substr(0, 4095)) << "one more character has 4097";
}

TEST_F(Configuration, OfALimitIsAnotherTextOfTheRecipesFile) {
  start();
  const json limit{{"alarm", 2}, {"region", "pool"}, {"signal", "hot_spot_width"}};
  json higher = limit, none = limit;
  higher.update({{"limit", "high_alarm"}, {"value", 30.5}});
  none.update({{"limit", "low_alarm"}, {"value", nullptr}});
  const json body{{"recipe", 1}, {"limits", {higher, none}}};
  const auto recipe = [&](const std::string& what, const json& sent) {
    return post("/api/v1/" + what + "_recipe", sent.dump(),
                by_token(Role::Integrator) + kJsonHeader);
  };
  const std::string lines =
      "pool hot_spot_width 2 high_alarm 30.500000\npool hot_spot_width 2 low_alarm\n";
  EXPECT_EQ(json::parse(recipe("check", body).body)["difference"], "+a = 1\n" + lines);
  EXPECT_TRUE(shown()["trial"].is_null()) << "a check changes nothing";
  ASSERT_EQ(recipe("try", body).status, 200);
  EXPECT_EQ(shown()["trial"]["files"]["rig.toml"], "a = 1\n" + lines);
  EXPECT_EQ(shown()["trial"]["seconds_left"], 60);
  EXPECT_EQ(recipe("try", {{"recipe", 2}}).status, 409);
  EXPECT_EQ(recipe("try", {{"recipe", 1}, {"limits", {limit}}}).status, 400);
  const json audit = json::parse(get(port(), "/api/v1/audit", by_token(Role::Administrator)).body);
  EXPECT_EQ(audit["entries"][0]["what"], "try_recipe");
  EXPECT_THAT(audit["entries"][0]["after"].get<std::string>(), HasSubstr(lines));
  EXPECT_EQ(audit["entries"][1]["result"], "refused");
}

TEST_F(Configuration, WithoutFilesIsRefused) {
  program.files = nullptr;
  start();
  const std::string headers = by_token(Role::Administrator);
  EXPECT_EQ(get(port(), "/api/v1/configuration", headers).status, 409);
  const std::string texts = R"({"files": {}})", recipe = R"({"recipe": 1})";
  const std::map<std::string, std::string> bodies{
      {"check_configuration", texts},  {"try_configuration", texts},
      {"check_recipe", recipe},        {"try_recipe", recipe},
      {"confirm_configuration", "{}"}, {"revert_configuration", "{}"}};
  for (const auto& [what, body] : bodies) {
    const Answer refused = post("/api/v1/" + what, body, headers + kJsonHeader);
    EXPECT_EQ(refused.status, 409) << what;
    EXPECT_THAT(refused.body, HasSubstr("there are no configuration files")) << what;
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
