// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/api/json_form.h"

#include <gmock/gmock.h>

#include "app/ports/web/api/record_schema.h"

namespace orbwatch::app::web::tests {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

enum class FormSide { Left, Right };
constexpr std::array kFormSides{Word{"left", FormSide::Left}, Word{"right", FormSide::Right}};

struct FormCorner {
  std::array<double, 2> at{};
  FormSide side = FormSide::Left;
};
template <class Visitor>
void visit(Visitor& v, FormCorner& corner) {
  v.required("at", corner.at, "Place");
  v.optional("side", corner.side, kFormSides, "Side");
}

struct Form {
  std::string user;
  std::optional<double> limit;
  int seconds = 60;
  bool is_last = false;
  std::vector<FormCorner> corners;
  std::map<std::string, std::string> texts;
};
template <class Visitor>
void visit(Visitor& v, Form& body) {
  v.required("user", body.user, "Name");
  v.required("limit", body.limit, Range::between(-5, 5), "Limit; null: none", "mm");
  v.optional("seconds", body.seconds, Range::between(10, 3600), "Time", "s");
  v.optional("is_last", body.is_last, "Flag");
  v.optional("corners", body.corners, "Corners");
  v.optional("texts", body.texts, "Texts");
  v.require(body.user != "nobody", "nobody is no user");
}

const Json kFormSchema = schema_of<Form, Sent::ByClient>();

std::string refusal_of_form(std::string_view body) {
  const auto record = parse_body(body, kFormSchema).and_then(record_of<Form>);
  return record ? "accepted" : record.error().message;
}

TEST(JsonForm, AcceptsWhatTheSchemaDescribes) {
  const auto body = parse_body(
                        R"({"user":"kim","limit":null,"seconds":90.0,"is_last":true,
          "corners":[{"at":[1,2.5],"side":"right"},{"at":[0,0]}],"texts":{"a":"b"}})",
                        kFormSchema)
                        .and_then(record_of<Form>);
  ASSERT_TRUE(body) << body.error().message;
  EXPECT_EQ(body->user, "kim");
  EXPECT_FALSE(body->limit);
  EXPECT_EQ(body->seconds, 90);
  EXPECT_TRUE(body->is_last);
  ASSERT_EQ(body->corners.size(), 2U);
  EXPECT_EQ(body->corners[0].at, (std::array<double, 2>{1, 2.5}));
  EXPECT_EQ(body->corners[0].side, FormSide::Right);
  EXPECT_EQ(body->corners[1].side, FormSide::Left);
  EXPECT_EQ(body->texts.at("a"), "b");
  const auto usual =
      parse_body(R"({"user":"kim","limit":2})", kFormSchema).and_then(record_of<Form>);
  ASSERT_TRUE(usual);
  EXPECT_EQ(usual->seconds, 60);
  EXPECT_EQ(usual->limit, 2);
}

TEST(JsonForm, RefusesAnythingElseByItsName) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "user is missing; it must be a string"},
      {"[]", "the body is not a JSON object"},
      {"{", "the body is not a JSON object"},
      {R"({"user":"kim"})", "limit is missing; it must be -5 to 5 mm or null"},
      {R"({"user":"kim","limit":6})", "limit is 6; it must be -5 to 5 mm or null"},
      {R"({"user":"kim","limit":"1"})", "limit must be -5 to 5 mm or null"},
      {R"({"user":"kim","limit":1,"seconds":9})",
       "seconds is 9; it must be a whole number, 10 to 3600 s"},
      {R"({"user":"kim","limit":1,"seconds":10.5})", "seconds is 10.5; it must be a whole number"},
      {R"({"user":"kim","limit":1,"seconds":1e300})", "seconds is 1e+300; it must be a whole"},
      {R"({"user":"kim","limit":1,"seconds":null})", "seconds must be a whole number"},
      {R"({"user":"kim","limit":1,"is_last":1})", "is_last is 1; it must be true or false"},
      {R"({"user":"kim","limit":1,"corners":{}})", "corners must be [{"},
      {R"({"user":"kim","limit":1,"corners":[{"at":[1]}]})", "corners[0].at must be ["},
      {R"({"user":"kim","limit":1,"corners":[{"at":[1,2]},{"at":[1,"2"]}]})",
       "corners[1].at[1] must be"},
      {R"({"user":"kim","limit":1,"corners":[{"at":[1,2],"side":"up"}]})",
       "corners[0].side must be one of left, right"},
      {R"({"user":"kim","limit":1,"corners":[{"at":[1,2],"up":1}]})",
       "corners[0] has an unknown member"},
      {R"({"user":"kim","limit":1,"texts":{"a":1}})", "texts.a must be a string"},
      {R"({"user":"nobody","limit":1})", "nobody is no user"},
  };
  for (const auto& [body, message] : cases)
    EXPECT_THAT(refusal_of_form(body), StartsWith(message)) << body;
  EXPECT_THAT(refusal_of_form(""), HasSubstr(R"(the body must be {"user": a string, "limit": )"));
}

/// A secret may stand at any place.
TEST(JsonForm, NeverQuotesATextOrAName) {
  for (const char* body :
       {R"({"user":{"SECRET":1},"limit":1})", R"({"user":"kim","limit":"SECRET"})",
        R"({"user":"kim","limit":1,"SECRET":1})", R"({"user":"kim","limit":1,"corners":"SECRET"})",
        R"({"user":"kim","limit":1,"corners":[{"at":[1,2],"side":"SECRET"}]})"}) {
    EXPECT_THAT(refusal_of_form(body), Not(HasSubstr("SECRET"))) << body;
    EXPECT_NE(refusal_of_form(body), "accepted") << body;
  }
  EXPECT_THAT(refusal_of_form(R"({"user":4711,"limit":1})"), Not(HasSubstr("4711")));
}

TEST(JsonForm, MayBeNestedDeeply) {
  const std::string deep = std::string(60000, '[') + std::string(60000, ']');
  EXPECT_NE(refusal_of_form(deep), "accepted");
  EXPECT_NE(refusal_of_form(R"({"user":"kim","limit":1,"corners":)" + deep + "}"), "accepted");
}

}  // namespace
}  // namespace orbwatch::app::web::tests
