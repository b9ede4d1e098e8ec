// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/configuration/configuration_body.h"

#include <gmock/gmock.h>

namespace orbwatch::app::web {
namespace {

using testing::HasSubstr;

TEST(ConfigurationBody, KeepsTextsByteForByte) {
  const auto body =
      parse_configuration(R"({"files": {"a.toml": "x = 1 # \u00e9\r\n\n", "b": ""}})");
  ASSERT_TRUE(body) << body.error().message;
  EXPECT_EQ(body->edit.texts,
            (ConfigurationFiles::Texts{{"a.toml", "x = 1 # \xC3\xA9\r\n\n"}, {"b", ""}}));
  EXPECT_EQ(body->seconds, 60);
  EXPECT_EQ(parse_configuration(R"({"files": {}, "seconds": 10})")->seconds, 10);
}

TEST(ConfigurationBody, RefusesWhatIsNone) {
  const auto refusal = [](std::string_view text) {
    const auto body = parse_configuration(text);
    return body ? "accepted" : body.error().message;
  };
  for (const char* text : {"", "{", "[]", "{}", R"({"files": []})", R"({"files": "a"})",
                           "{\"files\": {\"a\": \"\xFF\"}}"}) {
    EXPECT_THAT(refusal(text), HasSubstr("files must be an object")) << text;
  }
  EXPECT_THAT(refusal(R"({"files": {"a": 1}})"), HasSubstr("a must be a string"));
  EXPECT_THAT(refusal(R"({"files": {}, "based_on": []})"), HasSubstr("based_on is not an object"));
  EXPECT_THAT(refusal(R"({"files": {}, "based_on": {"a": 1}})"), HasSubstr("a is not a string"));
  EXPECT_THAT(refusal(R"({"files": {}, "second": 60})"), HasSubstr("unknown member second"));
  for (const char* seconds : {"9", "3601", "60.5", "\"60\"", "null", "1e99", "-60"}) {
    EXPECT_THAT(refusal(R"({"files": {}, "seconds": )" + std::string(seconds) + "}"),
                HasSubstr("must be a whole number from 10 to 3600"))
        << seconds;
  }
}

}  // namespace
}  // namespace orbwatch::app::web
