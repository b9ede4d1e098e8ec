// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/configuration/recipe_records.h"

#include <gmock/gmock.h>

#include "app/ports/web/api/record_schema.h"

namespace orbwatch::app::web {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(const std::string& text) {
  const auto body = parse_record<RecipeBody>(text);
  return body ? "accepted" : body.error().message;
}

/// Refusal of a body with one limit or region.
std::string refusal_of(const std::string& list, const std::string& one) {
  return refusal(R"({"recipe": 1, ")" + list + R"(": [)" + one + "]}");
}

TEST(RecipeRecords, HaveLimitsAndRegions) {
  const auto body = parse_record<RecipeBody>(
      R"({"recipe": 7, "seconds": 30, "copy": {"number": 9, "name": "thin"},
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
  const auto& [limits, regions, copy] = body->change;
  EXPECT_EQ(copy->number, 9);
  EXPECT_EQ(copy->name, "thin");
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

TEST(RecipeRecords, RefuseAnotherBody) {
  for (const char* text :
       {"", "[]", "{}", R"({"recipe": "1"})", R"({"recipe": -1})", R"({"recipe": 1.5})",
        R"({"recipe": 65536})", R"({"recipe": 1e400})", R"({"recipe": 1, "limit": []})",
        R"({"recipe": 1, "limits": {}})", R"({"recipe": 1, "regions": null})"}) {
    EXPECT_THAT(refusal(text), HasSubstr(R"(the body must be {"recipe": a whole number, 0 to )"))
        << text;
  }
  EXPECT_THAT(refusal(R"({"recipe": 1, "seconds": 9})"), StartsWith("seconds is 9; it must be"));
}

TEST(RecipeRecords, RefuseAMalformedLimit) {
  const std::string rest = R"("region": "", "signal": "", "limit": "a"})";
  EXPECT_EQ(refusal_of("limits", R"({"alarm": 1, "value": null, )" + rest), "accepted");
  EXPECT_EQ(refusal_of("limits", R"({"alarm": 0, "value": 1, )" + rest), "accepted");
  for (const std::string& limit :
       {std::string("1"), std::string("{}"), R"({"alarm": 1, "value": "1", )" + rest,
        R"({"alarm": -1, "value": 1, )" + rest, R"({"alarm": 0.5, "value": 1, )" + rest,
        R"({"alarm": 1e300, "value": 1, )" + rest, R"({"alarm": true, "value": 1, )" + rest,
        R"({"alarm": 1, )" + rest, R"({"x": 1, "alarm": 1, "value": 1, )" + rest}) {
    EXPECT_THAT(refusal_of("limits", limit), StartsWith("limits[0]")) << limit;
  }
}

TEST(RecipeRecords, RefuseAMalformedRegion) {
  for (const char* region :
       {"1", "{}", R"({"name": 1})", R"({"name": "a", "points": [[1, 2, 3]], "view": 1})",
        R"({"name": "a", "more": 1})", R"({"removed": true})", R"({"name": "a", "removed": 1})"}) {
    EXPECT_THAT(refusal_of("regions", region), StartsWith("regions[0]")) << region;
  }
  for (const char* region :
       {R"({"name": "a"})", R"({"name": "a", "removed": false})", R"({"name": "a", "points": []})",
        R"({"name": "a", "removed": true, "points": [[1, 2, 3]]})",
        R"({"name": "a", "removed": true, "view": "b", "hot_spot_threshold": 1})"}) {
    EXPECT_THAT(refusal_of("regions", region), HasSubstr("either directions or points, or only"))
        << region;
  }
  const std::string corners = R"({"name": "a", "points": [[1, 2, 3]], )";
  for (const char* half : {R"("view": "b"})", R"("hot_spot_threshold": 1})"}) {
    EXPECT_THAT(refusal_of("regions", corners + half),
                HasSubstr("both view and hot_spot_threshold"))
        << half;
  }
  for (const char* wrong : {"1", "[1]", "[[1]]", "[[1, 2, 3]]", R"([["1", 2]])", "[[1, null]]"}) {
    EXPECT_THAT(refusal_of("regions", R"({"name": "a", "directions": )" + std::string(wrong) + "}"),
                StartsWith("regions[0].directions"))
        << wrong;
  }
}

}  // namespace
}  // namespace orbwatch::app::web
