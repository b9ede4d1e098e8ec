// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/entity_tag.h"

#include <gtest/gtest.h>

namespace orbwatch::app::web {
namespace {

constexpr const char* kTag = "W/\"85944171f73967e8\"";

/// Answer, with a tag and two headers, to a request with these lines of If-None-Match.
Response answer_to(const std::vector<std::string>& lines) {
  Request request;
  for (const std::string& line : lines) request.headers.emplace_back("if-none-match", line);
  Response response = body_response(kText, "foobar");
  response.tag = kTag;
  response.headers = {{"Vary", "Accept-Encoding"}, {"Content-Encoding", "gzip"}};
  return if_none_match(request, std::move(response));
}

/// Published values of FNV-1a (draft-eastlake-fnv).
TEST(EntityTag, IsTheWeakTagOfTheHash) {
  EXPECT_EQ(entity_tag(""), "W/\"cbf29ce484222325\"");
  EXPECT_EQ(entity_tag("a"), "W/\"af63dc4c8601ec8c\"");
  EXPECT_EQ(entity_tag("foobar"), kTag);
}

TEST(EntityTag, OfTheClientLeavesOutTheBody) {
  for (const char* line :
       {"W/\"85944171f73967e8\"", "\"85944171f73967e8\"", "*", "\"other\", W/\"85944171f73967e8\"",
        "\"a,b\" , \"85944171f73967e8\" "}) {
    const Response answer = answer_to({line});
    EXPECT_EQ(answer.status, 304) << line;
    EXPECT_FALSE(answer.body) << line;
    EXPECT_EQ(answer.tag, kTag);
    EXPECT_EQ(answer.headers, (Values{{"Vary", "Accept-Encoding"}}));
  }
  EXPECT_EQ(answer_to({"\"other\"", kTag}).status, 304);
}

TEST(EntityTag, OfAnotherContentDoesNot) {
  for (const std::vector<std::string>& lines :
       std::vector<std::vector<std::string>>{{},
                                             {""},
                                             {"\"other\""},
                                             {"85944171f73967e8"},
                                             {"w/\"85944171f73967e8\""},
                                             {"\"85944171f73967e8"},
                                             {"W/W/\"85944171f73967e8\""}}) {
    const Response answer = answer_to(lines);
    EXPECT_EQ(answer.status, 200) << (lines.empty() ? "no header" : lines[0]);
    ASSERT_TRUE(answer.body);
    EXPECT_EQ(*answer.body, "foobar");
    EXPECT_EQ(answer.headers.size(), 2U);
  }
}

TEST(EntityTag, IsNeededForAnAnswerWithoutABody) {
  Request request;
  request.headers = {{"If-None-Match", "*"}};
  EXPECT_EQ(if_none_match(request, json_response("{}")).status, 200);
}

}  // namespace
}  // namespace orbwatch::app::web
