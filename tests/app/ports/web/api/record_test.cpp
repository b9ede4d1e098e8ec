// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/api/record.h"

#include <gtest/gtest.h>

#include <limits>

#include "app/model/status/status.h"
#include "app/ports/web/api/record_schema.h"

namespace orbwatch::app::web::tests {
namespace {

struct Named {
  std::string name;
  std::optional<std::string> note;
};
template <class Visitor>
void visit(Visitor& v, Named& part) {
  v.required("name", part.name, "Name");
  v.optional("note", part.note, "Note");
}

struct Measured {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::optional<int> count;
  SystemState state = SystemState::Running;
  optics::Vec3 point{1, 2.5, 3};
  std::vector<Named> parts;
  std::vector<std::pair<std::string, std::string>> versions;
};
template <class Visitor>
void visit(Visitor& v, Measured& answer) {
  v.required("value", answer.value, "Value", "mm");
  v.required("count", answer.count, "Count; null: unknown");
  v.required("state", answer.state, "State");
  v.required("point", answer.point, "Point");
  v.required("parts", answer.parts, "Parts");
  v.required("versions", answer.versions, "Versions");
}

TEST(Record, IsWrittenMemberByMember) {
  Measured answer;
  answer.parts = {{"a", std::nullopt}, {"b", "second"}};
  answer.versions = {{"z", "1"}, {"a", "2"}};
  EXPECT_EQ(json_text(json_of(answer)),
            R"({"value":null,"count":null,"state":1,"state_text":"running: every camera delivers",)"
            R"("point":[1.0,2.5,3.0],"parts":[{"name":"a"},{"name":"b","note":"second"}],)"
            R"("versions":{"z":"1","a":"2"}})");
}

TEST(Record, BytesThatAreNotUtf8AreReplaced) {
  Named part{"\xff", std::nullopt};
  EXPECT_EQ(json_text(json_of(part)), "{\"name\":\"\xEF\xBF\xBD\"}");
}

TEST(Record, IsDescribedAsItIsWritten) {
  const Json schema = schema_of<Measured, Sent::ByUs>();
  const Json& members = schema["properties"];
  EXPECT_EQ(members["value"]["x-unit"], "mm");
  EXPECT_EQ(members["value"]["nullable"], true);
  EXPECT_EQ(members["count"]["type"], "integer");
  EXPECT_EQ(members["state_text"]["type"], "string");
  EXPECT_EQ(members["parts"]["items"]["required"], Json::array({"name"}));
  for (const Sent sent : {Sent::ByUs, Sent::ByClient}) {
    Measured answer;
    answer.parts = {{"a", std::nullopt}, {"b", "second"}};
    answer.value = 1;
    const Json own = sent == Sent::ByUs ? schema : schema_of<Measured, Sent::ByClient>();
    EXPECT_TRUE(check_form(json_of(answer), own, ""));
  }
  EXPECT_TRUE(check_form(json_of(*std::make_unique<Measured>()), schema, "")) << "NaN is null";
}

struct Size {
  int width = 480;
  std::optional<std::string> name;
};
template <class Visitor>
void visit(Visitor& v, Size& query) {
  v.optional("width", query.width, Range::between(16, 1920), "Width", "px");
  v.optional("name", query.name, "Name");
}

TEST(Record, ArgumentsOfClientsHaveTheirDefaults) {
  const Json members = schema_of<Size, Sent::ByClient>()["properties"];
  EXPECT_EQ(members["width"]["default"], 480);
  EXPECT_EQ(members["width"]["minimum"], 16);
  EXPECT_FALSE(members["name"].contains("default"));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
