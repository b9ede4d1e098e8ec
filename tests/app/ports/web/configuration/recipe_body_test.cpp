// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/configuration/recipe_body.h"

#include <gmock/gmock.h>

namespace orbwatch::app::web {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(RecipeBody, HasLimitsAndRegions) {
  const auto body = parse_recipe_change(
      R"({"recipe": 7, "seconds": 30,
          "limits": [{"alarm": 1, "region": "pool", "signal": "plume_area", "limit": "low_alarm",
                      "value": -1.5},
                     {"alarm": 2, "region": "", "signal": "", "limit": "", "value": null}],
          "regions": [{"name": "pool", "points": [[1, 2, 3.5]]},
                      {"name": "new", "view": "front", "hot_spot_threshold": 900,
                       "directions": [[10, -20]]},
                      {"name": "old", "removed": true}]})");
  ASSERT_TRUE(body) << body.error().message;
  EXPECT_EQ(body->recipe, 7);
  EXPECT_EQ(body->seconds, 30);
  const auto& [limits, regions] = body->change;
  ASSERT_EQ(limits.size(), 2U);
  EXPECT_EQ(limits[0].alarm, 1U);
  EXPECT_EQ(limits[0].signal, "plume_area");
  EXPECT_EQ(limits[0].value, -1.5);
  EXPECT_FALSE(limits[1].value);
  ASSERT_EQ(regions.size(), 3U);
  EXPECT_THAT(regions[0].points, ElementsAre(std::array{1.0, 2.0, 3.5}));
  EXPECT_FALSE(regions[0].added);
  EXPECT_THAT(regions[1].directions, ElementsAre(std::array{10.0, -20.0}));
  EXPECT_EQ(regions[1].added->view, "front");
  EXPECT_EQ(regions[1].added->hot_spot_threshold, 900);
  EXPECT_FALSE(regions[1].is_removed);
  EXPECT_EQ(regions[2].name, "old");
  EXPECT_TRUE(regions[2].is_removed);
}

TEST(RecipeBody, RefusesWhatIsNone) {
  const auto refusal = [](const std::string& text) {
    const auto body = parse_recipe_change(text);
    return body ? "accepted" : body.error().message;
  };
  for (const char* text :
       {"", "[]", "{}", R"({"recipe": "1"})", R"({"recipe": -1})", R"({"recipe": 1.5})",
        R"({"recipe": 65536})", R"({"recipe": 1e400})", R"({"recipe": 1, "limit": []})"}) {
    EXPECT_THAT(refusal(text), HasSubstr("no changes of a recipe")) << text;
  }
  const auto of = [&](const std::string& list, const std::string& what) {
    return refusal(R"({"recipe": 1, ")" + list + R"(": )" + what + "}");
  };
  EXPECT_THAT(of("seconds", "9"), HasSubstr("from 10 to 3600"));
  EXPECT_THAT(of("limits", "{}"), HasSubstr("limits is not a list"));
  const std::string limit = R"("region": "", "signal": "", "limit": "a")";
  for (const std::string text : {"1", "{}", R"({"alarm": 1, "value": "1", )",
                                 R"({"alarm": -1, "value": 1, )", R"({"alarm": true, "value": 1, )",
                                 R"({"alarm": 1, )", R"({"x": 1, "alarm": 1, "value": 1, )"}) {
    const std::string whole = text.ends_with(", ") ? text + limit + "}" : text;
    EXPECT_THAT(of("limits", "[" + whole + "]"), HasSubstr("a limit is malformed")) << whole;
  }
  for (const char* text :
       {"1", "{}", R"({"name": 1})", R"({"name": "a", "view": "b"})",
        R"({"name": "a", "view": 1, "hot_spot_threshold": 1})", R"({"name": "a", "more": 1})",
        R"({"name": "a", "removed": false})", R"({"removed": true})",
        R"({"name": "a", "removed": true, "points": []})"}) {
    EXPECT_THAT(of("regions", "[" + std::string(text) + "]"), HasSubstr("a region is malformed"))
        << text;
  }
  for (const char* corners : {"1", "[1]", "[[1]]", "[[1, 2, 3]]", R"([["1", 2]])", "[[1, null]]"}) {
    EXPECT_THAT(of("regions", R"([{"name": "a", "directions": )" + std::string(corners) + "}]"),
                HasSubstr("directions"))
        << corners;
  }
}

}  // namespace
}  // namespace orbwatch::app::web
