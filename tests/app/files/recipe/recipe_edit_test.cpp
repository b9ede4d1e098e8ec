// SPDX-License-Identifier: Apache-2.0
#include "app/files/recipe/recipe_edit.h"

#include <gmock/gmock.h>

#include <fstream>
#include <random>
#include <sstream>
#include <utility>

#include "app/files/recipe/recipe_file.h"
#include "tests/app/files/replaced.h"

namespace orbwatch::app::files {
namespace {

using testing::HasSubstr;

const std::string kRecipe = R"(# By hand: größer
name = "cladding"

[[view]]                         # both blended
name = "process"
measured = "thermal"
width = 640
height = 480
[[view.source]]
camera = "thermal"

[[region]]                       # where it melts
name = "pool"
view = "process"
points = [[-190, -130, 178],     # left
          [-30, -130.50, 178], [-30, 30, 178]]  # the workpiece
hot_spot_threshold = 1400        # degC

[[region.alarm]]
signal = "hot_spot_width"
low_warning = 14                 # it does not stick
high_warning = 26
hysteresis = 0.50

# asked for by quality assurance
[[region.alarm]]
signal = "hot_spot_peak_temperature"
high_alarm = 2_400

[[region]]                       # the whole view
name = "surroundings"
view = "process"
hot_spot_threshold = 1400

# what the cameras get
[[control]]
camera = "thermal"
name = "exposure"
value = 3)";

const LimitChange kHigher{1, "pool", "hot_spot_width", "high_warning", 27.5};

Result<std::string> changed(const RecipeChange& change, const std::string& text = kRecipe) {
  return changed_recipe(text, "recipe.toml", change);
}

std::string refusal(const RecipeChange& change, const std::string& text = kRecipe) {
  const auto made = changed(change, text);
  return made ? "accepted" : made.error().message;
}

std::string recipe_with(const std::string& what, const std::string& with,
                        const std::string& text = kRecipe) {
  return replaced(what, with, text);
}

pipeline::Recipe recipe_of(const std::string& text) {
  auto recipe = parse_recipe(text, "recipe.toml");
  EXPECT_TRUE(recipe) << recipe.error().message;
  return recipe ? *recipe : pipeline::Recipe{};
}

TEST(RecipeEdit, SetsALimitAndKeepsEveryOtherByte) {
  const auto text = changed({{kHigher}});
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, recipe_with("high_warning = 26", "high_warning = 27.5"));
}

TEST(RecipeEdit, AddsAndRemovesLimits) {
  const auto text = changed({{{1, "pool", "hot_spot_width", "high_alarm", 30.0},
                              {1, "pool", "hot_spot_width", "low_warning", {}},
                              {2, "pool", "hot_spot_peak_temperature", "hysteresis", 20.0}}});
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text,
            recipe_with("hysteresis = 0.50\n", "hysteresis = 0.50\nhigh_alarm = 30\n",
                        recipe_with("low_warning = 14                 # it does not stick\n", "",
                                    recipe_with("2_400\n", "2_400\nhysteresis = 20\n"))));
}

TEST(RecipeEdit, ACopyHasItsChangesAndAnotherName) {
  const auto text = changed({{kHigher}, {}, RecipeCopy{2, "thin_wall"}});
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, recipe_with("high_warning = 26", "high_warning = 27.5",
                               recipe_with("name = \"cladding\"", "name = \"thin_wall\"")));
}

TEST(RecipeEdit, TheNameOfACopyIsThatOfAFileBesideTheOthers) {
  for (const char* name : {"a", "thin_wall-2", "0123456789012345678901234567890123456789"}) {
    EXPECT_TRUE(check_recipe_name(name)) << name;
  }
  for (const char* name : {"", ".", "..", "../thin", "a/b", "a b", "a.toml", "gr\xC3\xB6\xC3\x9F",
                           "a\nb", "a\"", "01234567890123456789012345678901234567890"}) {
    const auto refused = check_recipe_name(name);
    ASSERT_FALSE(refused) << name;
    EXPECT_THAT(refused.error().message, HasSubstr("1 to 40 letters, digits, - and _"));
  }
}

TEST(RecipeEdit, ANewRecipeIsNamedBehindTheOthers) {
  const std::string before =
      "rig = \"rig.toml\"  # mine\n[[recipe]]\nnumber = 1\nfile = \"a.toml\"\n";
  const std::string after = "\n[web]\nenabled = true\n";
  const auto site = with_recipe(before + after, "site.toml", 7, "thin.toml");
  ASSERT_TRUE(site) << site.error().message;
  EXPECT_EQ(*site, before + "\n[[recipe]]\nnumber = 7\nfile = \"thin.toml\"\n" + after);
  const auto taken = with_recipe(*site, "site.toml", 7, "other.toml");
  ASSERT_FALSE(taken);
  EXPECT_THAT(taken.error().message, HasSubstr("site.toml: recipe 7 exists already"));
  EXPECT_FALSE(with_recipe(after, "site.toml", 1, "thin.toml"));
}

TEST(RecipeEdit, KeepsTheEndsOfLines) {
  std::string with_returns;
  for (const char c : kRecipe) with_returns += c == '\n' ? "\r\n" : std::string(1, c);
  const auto text =
      changed({{{1, "pool", "hot_spot_width", "high_alarm", 30.0}}, {}}, with_returns);
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, recipe_with("hysteresis = 0.50\r\n", "hysteresis = 0.50\r\nhigh_alarm = 30\r\n",
                               with_returns));
}

TEST(RecipeEdit, MovesACornerAndKeepsTheOthersAsTheyAreWritten) {
  const auto text =
      changed({{}, {{"pool", {}, {{-190, -130, 178}, {-30, -130.5, 178}, {-20, 30, 178}}}}});
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, recipe_with("[-30, 30, 178]", "[-20, 30, 178]"));
}

TEST(RecipeEdit, GivesAWholeViewCorners) {
  const auto text = changed({{}, {{"surroundings", {{-100, -40}, {-90, -40}, {-90, -30}}}}});
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, recipe_with("hot_spot_threshold = 1400\n\n# what",
                               "hot_spot_threshold = 1400\n"
                               "directions = [[-100, -40], [-90, -40], [-90, -30]]\n\n# what"));
}

TEST(RecipeEdit, AddsARegionBehindTheOthers) {
  const auto text =
      changed({{}, {{"door", {{0, 0}, {10, 0}, {10, 10.25}}, {}, NewRegion{"process", 600}}}});
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, recipe_with("\n# what the cameras get",
                               "\n[[region]]\nname = \"door\"\nview = \"process\"\n"
                               "directions = [[0, 0], [10, 0], [10, 10.25]]\n"
                               "hot_spot_threshold = 600\n\n# what the cameras get"));
  EXPECT_EQ(recipe_of(*text).regions.back().directions[2][1], 10.25);
}

TEST(RecipeEdit, RemovesARegionWithItsAlarms) {
  RegionChange gone{"pool"};
  gone.is_removed = true;
  const auto text =
      changed({{}, {gone, {"door", {{0, 0}, {10, 0}, {10, 10}}, {}, {{"process", 600}}}}});
  ASSERT_TRUE(text) << text.error().message;
  const std::size_t begin = kRecipe.find("[[region]]"),
                    end = kRecipe.find("\n[[region]] ", begin + 1);
  ASSERT_NE(end, std::string::npos);
  EXPECT_TRUE(text->starts_with(kRecipe.substr(0, begin) + kRecipe.substr(end, 40))) << *text;
  const pipeline::Recipe recipe = recipe_of(*text);
  ASSERT_EQ(recipe.regions.size(), 2U);
  EXPECT_EQ(recipe.regions[0].name, "surroundings");
  EXPECT_EQ(recipe.regions[1].name, "door");
  EXPECT_TRUE(recipe.regions[0].alarms.empty());

  RegionChange other{"surroundings"};
  other.is_removed = true;
  EXPECT_THAT(refusal({{}, {gone, other}}), HasSubstr("region"));
  EXPECT_THAT(refusal({{kHigher}, {gone}}), HasSubstr("is removed, and limits of it changed"));
  EXPECT_EQ(recipe_of(*changed({{kHigher}, {other}})).regions.size(), 1U);
  gone.name = "never";
  EXPECT_THAT(refusal({{}, {gone}}), HasSubstr("there is no region never"));
}

TEST(RecipeEdit, AppliesAllChangesOrNone) {
  const RegionChange added{"door", {{0, 0}, {10, 0}, {10, 10}}, {}, NewRegion{"process", 600}};
  const RegionChange whole{"surroundings", {{0, 0}, {10, 0}, {10, 10}}};
  const auto text = changed({{kHigher}, {added, whole}});
  ASSERT_TRUE(text) << text.error().message;
  const pipeline::Recipe recipe = recipe_of(*text);
  EXPECT_EQ(recipe.regions.size(), 3U);
  EXPECT_EQ(recipe.regions[1].directions.size(), 3U);
  EXPECT_EQ(recipe.regions[0].alarms[0].high_warning, 27.5);
  EXPECT_THAT(refusal({{kHigher}, {{"never", {{0, 0}, {1, 0}, {1, 1}}}}}),
              HasSubstr("there is no region never"));
}

TEST(RecipeEdit, RefusesWhatIsNotThereOrIsAnother) {
  EXPECT_THAT(refusal({{{3, "pool", "hot_spot_width", "low_alarm", 1.0}}}),
              HasSubstr("there is no alarm 3 of 2"));
  EXPECT_THAT(refusal({{{2, "pool", "hot_spot_width", "low_alarm", 1.0}}}),
              HasSubstr("alarm 2 watches hot_spot_peak_temperature of region pool"));
  EXPECT_THAT(refusal({{{1, "pool", "hot_spot_width", "latching", 1.0}}}),
              HasSubstr("no limit \"latching\""));
  EXPECT_THAT(refusal({{kHigher, kHigher}}), HasSubstr("is there twice"));
  EXPECT_THAT(refusal({{}, {{"pool", {{0, 0}, {1, 0}, {1, 1}}}}}), HasSubstr("corners are points"));
  EXPECT_THAT(refusal({{}, {{"pool"}}}), HasSubstr("either directions or points"));
  EXPECT_THAT(refusal({{}, {{"pool", {{0, 0}, {1, 0}, {1, 1}}, {}, NewRegion{"process", 1}}}}),
              HasSubstr("a region pool already"));
}

TEST(RecipeEdit, RefusesARecipeThatWouldBeWrong) {
  EXPECT_THAT(refusal({{{1, "pool", "hot_spot_width", "high_warning", 3.0}}}),
              HasSubstr("low warning 14 is not below high warning 3"));
  EXPECT_THAT(refusal({{{1, "pool", "hot_spot_width", "high_warning", NAN}}}),
              HasSubstr("recipe.toml:"));
  EXPECT_THAT(refusal({{}, {{"surroundings", {{0, 0}, {1, 0}}}}}), HasSubstr("three corners"));
  EXPECT_THAT(refusal({{}, {{"door", {{0, 0}, {1, 0}, {1, 1}}, {}, NewRegion{"never", 1}}}}),
              HasSubstr("no view \"never\""));
  EXPECT_THAT(refusal({{kHigher}}, "name = "), HasSubstr("recipe.toml:1"));
}

/// Names become quoted texts, whatever they contain.
TEST(RecipeEdit, RefusesNamesThatWouldBeMore) {
  for (const char* name : {"a\"\n[[control]]\n#", "a\nname = 1", "\xFF", "", "\\", "]]"}) {
    EXPECT_NE(refusal({{}, {{name, {{0, 0}, {1, 0}, {1, 1}}, {}, NewRegion{"process", 1}}}}),
              "accepted")
        << name;
    EXPECT_NE(refusal({{}, {{"door", {{0, 0}, {1, 0}, {1, 1}}, {}, NewRegion{name, 1}}}}),
              "accepted")
        << name;
    EXPECT_NE(refusal({{{1, "pool", "hot_spot_width", name, 1.0}}}), "accepted") << name;
  }
}

TEST(RecipeEdit, RefusesPlacesThatOnlyAPersonCanChange) {
  // More corners replace some with a comment in between.
  EXPECT_THAT(refusal({{}, {{"pool", {}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}}),
              HasSubstr("a comment between its corners"));
  const std::string line = recipe_with(
      "[[region.alarm]]\nsignal = \"hot_spot_width\"\nlow_warning = 14                 # it does "
      "not stick\nhigh_warning = 26\nhysteresis = 0.50\n\n# asked for by quality assurance\n"
      "[[region.alarm]]\nsignal = \"hot_spot_peak_temperature\"\nhigh_alarm = 2_400\n",
      "alarm = [{signal = \"hot_spot_width\", low_warning = 14, high_warning = 26}]\n");
  const auto set = changed({{kHigher}}, line);
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(*set, recipe_with("high_warning = 26", "high_warning = 27.5", line));
  EXPECT_THAT(refusal({{{1, "pool", "hot_spot_width", "high_alarm", 30.0}}}, line),
              HasSubstr("a header of its own"));
  EXPECT_THAT(refusal({{{1, "pool", "hot_spot_width", "low_warning", {}}}}, line),
              HasSubstr("recipe.toml"));
}

/// The lines of two texts that differ in one.
std::pair<std::string, std::string> the_other_line(const std::string& before,
                                                   const std::string& after) {
  std::istringstream old_lines(before), new_lines(after);
  std::pair<std::string, std::string> other;
  std::size_t others = 0;
  for (std::string a, b; std::getline(old_lines, a);) {
    EXPECT_TRUE(std::getline(new_lines, b));
    if (a == b) continue;
    other = {a, b};
    ++others;
  }
  EXPECT_EQ(others, 1U);
  EXPECT_EQ(new_lines.peek(), EOF);
  return other;
}

TEST(RecipeEdit, AddsAlarmsToASignalWithoutOne) {
  const auto made = changed({{
      {0, "pool", "spatter_rate", "high_warning", 30},
      {0, "pool", "spatter_rate", "hysteresis", 2.5},
      {0, "surroundings", "spatter_rate", "high_alarm", 90},
      {0, "surroundings", "hot_spot_area", "low_warning", 5},
  }});
  ASSERT_TRUE(made) << made.error().message;
  const std::string for_pool =
      "high_alarm = 2_400\n\n[[region.alarm]]\nsignal = \"spatter_rate\"\nhigh_warning = 30\n"
      "hysteresis = 2.5\n";
  const std::string for_surroundings =
      "hot_spot_threshold = 1400\n\n[[region.alarm]]\nsignal = \"hot_spot_area\"\nlow_warning = 5\n"
      "\n[[region.alarm]]\nsignal = \"spatter_rate\"\nhigh_alarm = 90\n\n# what the cameras get";
  EXPECT_EQ(*made, recipe_with("high_alarm = 2_400\n", for_pool,
                               recipe_with("hot_spot_threshold = 1400\n\n# what the cameras get",
                                           for_surroundings)));
  const auto recipe = recipe_of(*made);
  ASSERT_EQ(recipe.regions[0].alarms.size(), 3U);
  EXPECT_EQ(recipe.regions[0].alarms[2].high_warning, 30);
  EXPECT_EQ(recipe.regions[0].alarms[2].hysteresis, 2.5);
  ASSERT_EQ(recipe.regions[1].alarms.size(), 2U);
  EXPECT_EQ(recipe.regions[1].alarms[1].high_alarm, 90);
}

TEST(RecipeEdit, RefusesANewAlarmThatIsNotPossible) {
  const auto refused = [](const LimitChange& limit) { return refusal({{limit}}); };
  EXPECT_THAT(refused({0, "seam", "spatter_rate", "high_warning", 30}),
              HasSubstr("there is no region seam"));
  EXPECT_THAT(refused({0, "pool", "spatter_rate", "high_warning", std::nullopt}),
              HasSubstr("a new alarm must have a value of high_warning"));
  EXPECT_THAT(refused({0, "pool", "no_signal", "high_warning", 30}), HasSubstr("no_signal"));
  EXPECT_THAT(refused({0, "pool", "spatter_rate", "median", 30}), HasSubstr("no limit \"median\""));
  EXPECT_THAT(refusal({{{0, "pool", "spatter_rate", "high_warning", 30},
                        {0, "pool", "spatter_rate", "high_warning", 31}}}),
              HasSubstr("new alarm of pool spatter_rate: high_warning is there twice"));
}

/// Sets each limit of the shipped recipe to a random value.
TEST(RecipeEdit, ChangesOneLineOfTheShippedRecipe) {
  std::ostringstream read;
  read << std::ifstream(ORBWATCH_SOURCE_DIR "/platform/config/demo-recipe.toml").rdbuf();
  const std::string text = read.str();
  std::mt19937 random(18);
  std::uniform_real_distribution factor(0.99, 1.01);
  const auto region = recipe_of(text).regions[0];
  std::size_t tried = 0;
  for (std::size_t i = 0; i < region.alarms.size(); ++i) {
    for (const auto& limit : signals::kLimits) {
      const auto stated = region.alarms[i].*limit.value;
      if (!stated) continue;
      const double value = *stated * factor(random);
      const std::string signal(signals::kSignals[region.alarms[i].signal].name);
      const auto made = changed({{{i + 1, region.name, signal, limit.name, value}}}, text);
      ASSERT_TRUE(made) << made.error().message;
      const auto [before, after] = the_other_line(text, *made);
      EXPECT_THAT(before, testing::StartsWith(std::string(limit.name) + " = "));
      EXPECT_THAT(after, testing::StartsWith(std::string(limit.name) + " = "));
      EXPECT_NEAR(*(recipe_of(*made).regions[0].alarms[i].*limit.value), value, 1e-9 * value);
      ++tried;
    }
  }
  EXPECT_EQ(tried, 4U);
}

}  // namespace
}  // namespace orbwatch::app::files
