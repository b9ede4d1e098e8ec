// SPDX-License-Identifier: Apache-2.0
#include "app/files/recipe/recipe_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/app/files/refusal.h"
#include "tests/app/files/replaced.h"

namespace orbwatch::app::files {
namespace {

const std::string kValidRecipe = R"(
name = "cladding"
process_active = "detected"
[[view]]
name = "process"
measured = "a"
width = 64
height = 48
[[view.source]]
camera = "a"
[[view.source]]
camera = "b"
[[region]]
name = "pool"
view = "process"
directions = [[-10, 0], [10, 0], [0, 20]]
hot_spot_threshold = 1400
emissivity = 0.4
[[region.alarm]]
signal = "hot_spot_width"
high_warning = 6
high_alarm = 7
hysteresis = 0.5
on_delay = 0.2
[[control]]
camera = "a"
name = "ExposureTime"
value = 800
)";

std::string valid_recipe_with(const std::string& what, const std::string& with) {
  return replaced(what, with, kValidRecipe);
}

TEST(RecipeFile, IsReadAndTheRestIsByDefault) {
  const auto recipe = parse_recipe(kValidRecipe, "recipe.toml");
  ASSERT_TRUE(recipe) << recipe.error().message;
  EXPECT_EQ(recipe->process_active, pipeline::ActiveSource::Detected);
  EXPECT_EQ(recipe->views[0].measured.name, "a");
  EXPECT_EQ(recipe->views[0].sources[1].camera.name, "b");
  const pipeline::RegionOfInterest& region = recipe->regions[0];
  EXPECT_EQ(region.directions[2][1], 20);
  EXPECT_EQ(region.emissivity, 0.4);
  EXPECT_FALSE(region.plume_threshold);
  EXPECT_EQ(region.alarms[0].high_alarm, 7);
  EXPECT_FALSE(region.alarms[0].low_alarm);
  EXPECT_EQ(region.alarms[0].loss_delay, std::chrono::seconds(1));
  EXPECT_TRUE(region.alarms[0].only_while_active);
  EXPECT_EQ(recipe->controls[0].value, 800);
  EXPECT_EQ(recipe->settle_frames, 0);
}

class RefusedRecipe : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedRecipe, SaysWhatWhereAndWhatWouldBeRight) {
  const auto recipe = parse_recipe(GetParam().text, "recipe.toml");
  ASSERT_FALSE(recipe);
  expect_said(GetParam(), recipe.error());
}

INSTANTIATE_TEST_SUITE_P(
    All, RefusedRecipe,
    testing::Values(
        Refusal{"NoView", "name = \"x\"\n", {"view", "0 are given"}},
        Refusal{
            "UnknownSignal",
            valid_recipe_with("\"hot_spot_width\"", "\"width\""),
            {"recipe.toml:20: region.alarm.signal", "'width' is not allowed", "hot_spot_width"}},
        Refusal{"LimitsUpsideDown",
                valid_recipe_with("high_alarm = 7", "high_alarm = 5"),
                {"recipe.toml:19:", "region.alarm"}},
        Refusal{"RegionInNoView",
                valid_recipe_with("view = \"process\"", "view = \"other\""),
                {"recipe.toml:13:", "region.view", "\"other\""}},
        Refusal{"MeasuresACameraThatTheViewHasNot",
                valid_recipe_with("measured = \"a\"", "measured = \"c\""),
                {"recipe.toml:4:", "view.measured", "\"c\""}},
        Refusal{"TwoCorners",
                valid_recipe_with("[[-10, 0], [10, 0], [0, 20]]", "[[-10, 0], [10, 0]]"),
                {"region.directions", "three"}},
        Refusal{"DirectionsAndPoints",
                valid_recipe_with("emissivity",
                                  "points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nemissivity"),
                {"region.points", "either"}},
        Refusal{"CornersOfThree",
                valid_recipe_with("[[-10, 0], [10, 0], [0, 20]]", "[[1, 2, 3]]"),
                {"region.directions", "list of 2"}},
        Refusal{"NotANumber",
                valid_recipe_with("hot_spot_threshold = 1400", "hot_spot_threshold = nan"),
                {"region.hot_spot_threshold"}},
        Refusal{"InputWithoutALine",
                valid_recipe_with("\"detected\"", "\"input\""),
                {"process_active", "process_input"}},
        Refusal{"ALineThatNobodyAskedFor",
                valid_recipe_with("\"detected\"", "\"detected\"\nprocess_input = \"laser\""),
                {"process_input"}},
        Refusal{"UnknownKey", valid_recipe_with("emissivity", "emisivity"), {"emisivity"}},
        Refusal{"TwiceTheSameRegion",
                kValidRecipe + "[[region]]\nname='pool'\nview='process'\nhot_spot_threshold=1\n",
                {"region.name", "twice"}}),
    [](const auto& refusal) { return refusal.param.name; });

TEST(RecipeFile, MissingOnesAreRefusedByName) {
  TextFiles files;
  const auto recipe = load_recipe("/nonexistent/recipe.toml", files);
  ASSERT_FALSE(recipe);
  EXPECT_NE(recipe.error().message.find("/nonexistent/recipe.toml"), std::string::npos);
}

TEST(RecipeManual, IsWhatIsCommitted) {
  std::ifstream in(std::filesystem::path(ORBWATCH_SOURCE_DIR) / "app/files/RECIPE.md");
  std::stringstream committed;
  committed << in.rdbuf();
  EXPECT_EQ(committed.str(), recipe_manual())
      << "regenerate it: orbwatch describe recipe > app/files/RECIPE.md";
}

}  // namespace
}  // namespace orbwatch::app::files
