// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/configuration/configuration_records.h"

#include <gmock/gmock.h>

#include "app/ports/web/api/record_schema.h"

namespace orbwatch::app::web {
namespace {

using testing::HasSubstr;

TEST(ConfigurationRecords, KeepTextsByteForByte) {
  const auto body = parse_record<ConfigurationBody>(
      R"({"files": {"a.toml": "x = 1 # \u00e9\r\n\n", "b": ""}, "based_on": {"b": "0a1b2c3d"}})");
  ASSERT_TRUE(body) << body.error().message;
  EXPECT_EQ(body->edit.texts,
            (ConfigurationFiles::Texts{{"a.toml", "x = 1 # \xC3\xA9\r\n\n"}, {"b", ""}}));
  EXPECT_EQ(body->edit.based_on, (ConfigurationFiles::Basis{{"b", "0a1b2c3d"}}));
  EXPECT_EQ(body->seconds, 60);
  EXPECT_EQ(parse_record<ConfigurationBody>(R"({"files": {}, "seconds": 10})")->seconds, 10);
}

TEST(ConfigurationRecords, RefuseWhatIsNone) {
  const auto refusal = [](std::string_view text) {
    const auto body = parse_record<ConfigurationBody>(text);
    return body ? "accepted" : body.error().message;
  };
  const std::string form =
      R"(the body must be {"files": {"NAME": a string, ...}, "based_on": {"NAME": a string, ...} )"
      R"((optional), "seconds": a whole number, 10 to 3600 s (optional)})";
  for (const char* text : {"", "{", "[]", "{}", R"({"files": []})", R"({"files": "a"})",
                           "{\"files\": {\"a\": \"\xFF\"}}"}) {
    EXPECT_THAT(refusal(text), HasSubstr(form)) << text;
  }
  EXPECT_THAT(refusal(R"({"files": {"a": 1}})"), HasSubstr("files.a must be a string"));
  EXPECT_THAT(refusal(R"({"files": {}, "based_on": []})"),
              HasSubstr(R"(based_on must be {"NAME": a string, ...})"));
  EXPECT_THAT(refusal(R"({"files": {}, "based_on": {"a": 1}})"),
              HasSubstr("based_on.a must be a string"));
  EXPECT_THAT(refusal(R"({"files": {}, "second": 60})"), HasSubstr("unknown member"));
  for (const char* seconds : {"9", "3601", "60.5", "\"60\"", "null", "1e99", "-60"}) {
    EXPECT_THAT(refusal(R"({"files": {}, "seconds": )" + std::string(seconds) + "}"),
                testing::ContainsRegex("^seconds .*must be a whole number, 10 to 3600 s;"))
        << seconds;
  }
}

}  // namespace
}  // namespace orbwatch::app::web
