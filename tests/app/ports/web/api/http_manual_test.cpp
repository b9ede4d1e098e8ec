// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/api/http_manual.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "app/ports/web/api/record_schema.h"
#include "app/ports/web/routes.h"

namespace orbwatch::app::web {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Part {
  double size = 0;
};
template <class Visitor>
void visit(Visitor& v, Part& part) {
  v.required("size", part.size, "Its size", "mm");
}

struct Query {
  std::string name;
  int lines = 20;
};
template <class Visitor>
void visit(Visitor& v, Query& query) {
  v.required("name", query.name, "One | two");
  v.optional("lines", query.lines, Range::between(1, 500), "Most lines");
}

struct Answer {
  std::vector<Part> parts;
  std::optional<Part> newest;
  SystemState state{};
};
template <class Visitor>
void visit(Visitor& v, Answer& answer) {
  v.required("parts", answer.parts, "All parts");
  v.optional("newest", answer.newest, "Newest part");
  v.required("state", answer.state, "State");
}

Route made_route() {
  Route route{"GET", "/api/v1/parts", Role::Operator, "Returns the parts", std::string(kJson)};
  route.query = schema_of<Query, Sent::ByClient>;
  route.answer = schema_of<Answer, Sent::ByUs>;
  return route;
}

TEST(HttpManual, IsWhatIsCommitted) {
  std::ifstream in(std::string(ORBWATCH_SOURCE_DIR) + "/app/ports/web/HTTP.md");
  const std::string committed{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(committed == http_manual(routes_of({})))
      << "stale: orbwatch describe http > app/ports/web/HTTP.md";
}

TEST(HttpManual, NamesEveryRouteAndArgument) {
  const std::string manual = http_manual(routes_of({}));
  for (const Route& route : routes_of({})) {
    EXPECT_THAT(manual,
                HasSubstr(route.command ? "| `" + std::string(route.command->name) + "` |"
                                        : "\n## " + route.method + " " + route.path + "\n"));
    for (const SchemaMaker& maker : {route.query, route.body, route.answer}) {
      const Json members = maker ? maker().value("properties", Json::object()) : Json::object();
      for (const auto& member : members.items()) {
        EXPECT_THAT(manual, HasSubstr("| `" + member.key() + "` |")) << route.path;
      }
    }
  }
}

TEST(HttpManual, ShowsRequestRoleAndMembers) {
  const std::string manual = http_manual({made_route()});
  EXPECT_THAT(manual, HasSubstr("| `GET /api/v1/parts?name=[&lines=]` | operator | Returns the"));
  EXPECT_THAT(manual, HasSubstr("| `name` | a string | | required | One \\| two |"));
  EXPECT_THAT(manual, HasSubstr("| `lines` | a whole number, 1 to 500 | | 20 | Most lines |"));
  EXPECT_THAT(manual, HasSubstr("| `parts` | a list | | | All parts |\n"
                                "| `parts[].size` | any number or null | mm | | Its size |"));
  EXPECT_THAT(manual, HasSubstr("| `newest` | an object or null | | may be absent | Newest part"));
  EXPECT_THAT(manual, HasSubstr("| `state` | a code | | | State: 0 starting: no frame set yet; 1"));
  EXPECT_THAT(manual, Not(HasSubstr("Body:")));
}

TEST(HttpManual, LeavesOutFilesOfThePage) {
  Route page = made_route();
  page.is_page = true;
  EXPECT_THAT(http_manual({page}), Not(HasSubstr("/api/v1/parts")));
}

}  // namespace
}  // namespace orbwatch::app::web
