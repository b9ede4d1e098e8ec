// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/process/recipe_routes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/model/status/measured_recipe.h"
#include "proc/optics/rotation.h"
#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using optics::Vec3;
using testing::HasSubstr;

constexpr const char* kRecipePath = "/api/v1/recipe";

/// A recipe with a view along +Y.
MeasuredRecipe make_recipe(const optics::Ball& ball) {
  MeasuredRecipe recipe;
  recipe.number = app::tests::make_status().recipe;
  recipe.name = "cladding";
  const optics::ViewSpec spec{optics::ViewKind::Perspective, {}, 90, {}, 65, 49};
  recipe.views = {{"process", std::make_shared<const optics::ViewProjection>(
                                  optics::ViewProjection::make(spec).value())}};
  const std::vector<std::array<double, 3>> points{{0, 120, 20}, {30, 120, 20}, {30, 120, 50}};
  const std::vector<std::array<double, 2>> directions{{-10, 0}, {10, 0}, {180, 0}};
  recipe.regions = {{"pool", 0, {}, points, {}}, {"sparks", 0, directions, {}, {}}, {"all", 0}};
  for (const auto& [x, y, z] : points) {
    recipe.regions[0].outline.push_back(Vec3{x, y, z} - ball.centre);
  }
  recipe.regions[1].outline = {{-1, 5, 0}, {1, 5, 0}, {0, -1, 2}};
  signals::AlarmLimits limits;
  limits.signal = 3;
  limits.high_alarm = 30.5;
  limits.hysteresis = 0.5;
  recipe.alarms = {limits};
  return recipe;
}

/// Server with a recipe in a scene with a box.
class ServedRecipe : public Served {
 protected:
  void SetUp() override {
    WebContext context = make_context();
    context.ball = {{10, 20, 30}, 5};
    optics::Scene room;
    room.room = optics::Scene::Room::Box;
    room.walls = {{-90, -80, -70}, {110, 120, 130}};
    context.scene = optics::SceneProxy::make(room, context.ball).value();
    recipe = make_recipe(context.ball);
    context.recipes = {recipe};
    sink = std::make_unique<WebSink>(on_a_free_port(), context);
    const auto started = sink->start();
    ASSERT_TRUE(started) << started.error().message;
    sink->accept(app::tests::make_status());
  }
  json shown() const { return json::parse(get(port(), kRecipePath).body); }
  Answer polygon(const std::string& query) const {
    return get(port(), std::string(kRecipePath) + "/polygon" + query);
  }

  MeasuredRecipe recipe;
};

TEST_F(ServedRecipe, HasLimitsAndRegionsInItsViews) {
  const json all = shown();
  EXPECT_EQ(all["name"], "cladding");
  EXPECT_EQ(all["recipes"], json({{{"number", recipe.number}, {"name", "cladding"}}}));
  EXPECT_EQ(all["views"], json::parse(R"([{"name": "process", "width": 65, "height": 49}])"));
  const json& alarm = all["alarms"][0];
  EXPECT_EQ(alarm["alarm"], 1);
  EXPECT_EQ(alarm["region"], "pool");
  EXPECT_EQ(alarm["signal"], signals::kSignals[3].name);
  EXPECT_EQ(alarm["title"], "Hot spot area");
  EXPECT_EQ(alarm["high_alarm"], 30.5);
  EXPECT_TRUE(alarm["low_alarm"].is_null());
  EXPECT_EQ(alarm["hysteresis"], 0.5);

  const json &pool = all["regions"][0], &sparks = all["regions"][1];
  EXPECT_EQ(pool["kind"], "points");
  EXPECT_EQ(pool["corners"][1]["at"], json::parse("[30, 120, 20]"));
  // The corner is 100 mm away, 20 mm to the right and 10 mm down; 32.5 px correspond to 45 degrees.
  EXPECT_NEAR(pool["corners"][1]["pixel"][0], 32 + 0.2 * 32.5, 1e-9);
  EXPECT_NEAR(pool["corners"][1]["pixel"][1], 24 + 0.1 * 32.5, 1e-9);
  EXPECT_EQ(pool["lines"].size(), 1U);
  EXPECT_EQ(pool["lines"][0].front(), pool["lines"][0].back());
  EXPECT_EQ(sparks["kind"], "directions");
  EXPECT_TRUE(sparks["corners"][2]["pixel"].is_null()) << "behind";
  EXPECT_EQ(all["regions"][2]["kind"], "whole_view");
  EXPECT_EQ(all["regions"][2]["lines"][0][2], json::parse("[64.5, 48.5]"));
}

TEST_F(Served, WithoutRecipesTheRecipeIsEmpty) {
  start();
  const json none = json::parse(get(port(), kRecipePath).body);
  EXPECT_EQ(none["number"], 0);
  EXPECT_TRUE(none["regions"].empty() && none["alarms"].empty() && none["views"].empty());
  EXPECT_EQ(get(port(), std::string(kRecipePath) + "?number=1").status, 404);
}

/// A corner from a pixel is shown at that pixel.
TEST_F(ServedRecipe, GivesPlacesBackForPixels) {
  std::string pixels;
  const json pool = shown()["regions"][0];
  for (const json& corner : pool["corners"]) {
    pixels +=
        (pixels.empty() ? "" : ",") + corner["pixel"][0].dump() + "," + corner["pixel"][1].dump();
  }
  const Answer answer = polygon("?view=process&pixels=" + pixels);
  ASSERT_EQ(answer.status, 200) << answer.body;
  const json made_of_pixels = json::parse(answer.body);
  for (std::size_t i = 0; i < 3; ++i) {
    const json& corner = made_of_pixels["corners"][i];
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(corner["point"][k], pool["corners"][i]["at"][k], 1e-6);
    }
    const Vec3 direction =
        optics::rotation({corner["direction"][0], corner["direction"][1], 0}) * Vec3{0, 1, 0};
    EXPECT_LT(optics::norm(direction - optics::normalized(recipe.regions[0].outline[i])), 1e-9);
  }
  EXPECT_EQ(made_of_pixels["lines"].size(), pool["lines"].size());
}

TEST_F(ServedRecipe, RefusesWhatIsNoPolygon) {
  const auto refusal = [&](const std::string& query, int status = 400) {
    const Answer answer = polygon(query);
    EXPECT_EQ(answer.status, status) << query;
    return answer.body;
  };
  EXPECT_THAT(refusal(""), HasSubstr("view is missing; it must be a string"));
  EXPECT_THAT(refusal("?view=door&pixels=1,2", 404),
              HasSubstr("unknown view door; there are: process"));
  EXPECT_THAT(refusal("?view=process"), HasSubstr("pixels is missing; it must be a string"));
  for (const char* pixels : {"", "1", "1,2,3", "1,2,", ",1,2", "1,,2", "a,b", "1,2;3,4", "nan,1",
                             "inf,1", "1e9,1", "1e999,1", "0x1,2", " 1,2"}) {
    std::string query = pixels;
    if (query.starts_with(' ')) query = "%20" + query.substr(1);
    EXPECT_THAT(refusal("?view=process&pixels=" + query), HasSubstr("it must be u,v,u,v"))
        << pixels;
  }
  std::string many = "1,2";
  for (int i = 0; i < 64; ++i) many += ",1,2";
  EXPECT_THAT(refusal("?view=process&pixels=" + many), HasSubstr("at most 64 corners"));
  EXPECT_THAT(refusal("?view=process&pixels=1,2,3,4"), HasSubstr("at least 3 corners"));
  EXPECT_THAT(refusal("?view=process&number=9&pixels=1,2", 404),
              HasSubstr("unknown recipe 9; there are: " + std::to_string(recipe.number)));
  EXPECT_EQ(get(port(), std::string(kRecipePath) + "?number=9").status, 404);
  const Answer wrong = get(port(), std::string(kRecipePath) + "?number=cladding");
  EXPECT_EQ(wrong.status, 400);
  EXPECT_THAT(wrong.body, HasSubstr("number is cladding; it must be a whole number, 0 to 65535\""));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
