// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/access_body.h"

#include <gmock/gmock.h>

namespace orbwatch::app::web::tests {
namespace {

using testing::HasSubstr;

const std::vector<BodyMember> kAllowed{{"user", ""}, {"password", "", false}};

TEST(AccessBody, TextsByName) {
  const auto both = parse_members(kAllowed, R"({"user":"kim","password":"x"})");
  ASSERT_TRUE(both);
  EXPECT_EQ(both->at("user"), "kim");
  EXPECT_EQ(both->at("password"), "x");
  EXPECT_EQ(parse_members(kAllowed, R"({"user":"kim"})")->at("password"), "");
  EXPECT_TRUE(parse_members({}, ""));
}

TEST(AccessBody, WhatIsWrongIsRefusedWithoutAValue) {
  for (const char* body :
       {"", "[]", "{", "null", R"({"password":"SECRET"})", R"({"user":7,"password":"SECRET"})",
        R"({"user":"SECRET","password":null})", R"({"user":"SECRET","other":"SECRET"})",
        R"({"user":"SECRET","SECRET":"x"})"}) {
    const auto members = parse_members(kAllowed, body);
    ASSERT_FALSE(members) << body;
    EXPECT_THAT(members.error().message,
                HasSubstr(R"(must be {"user": "...", "password": "..." (optional)})"));
    EXPECT_EQ(members.error().message.find("SECRET"), std::string::npos) << body;
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
