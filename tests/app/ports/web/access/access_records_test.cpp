// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/access_records.h"

#include <gmock/gmock.h>

#include "app/ports/web/api/record_schema.h"

namespace orbwatch::app::web::tests {
namespace {

using testing::HasSubstr;

TEST(AccessRecords, AUserMayBeSentWithoutRoleAndPassword) {
  const auto both = parse_record<UserBody>(R"({"user":"kim","role":"operator","password":"x"})");
  ASSERT_TRUE(both) << both.error().message;
  EXPECT_EQ(both->user, "kim");
  EXPECT_EQ(both->role, Role::Operator);
  EXPECT_EQ(both->password, "x");
  const auto name = parse_record<UserBody>(R"({"user":"kim"})");
  ASSERT_TRUE(name) << name.error().message;
  EXPECT_FALSE(name->role);
  EXPECT_EQ(name->password, "");
}

TEST(AccessRecords, WhatIsWrongIsRefusedWithoutAValue) {
  for (const char* body :
       {"", "[]", "{", "null", R"({"password":"SECRET"})", R"({"user":7,"password":"SECRET"})",
        R"({"user":"SECRET","password":null})", R"({"user":"SECRET","role":"SECRET"})",
        R"({"user":"SECRET","other":"SECRET"})", R"({"user":"SECRET","SECRET":"x"})"}) {
    const auto refused = parse_record<UserBody>(body);
    ASSERT_FALSE(refused) << body;
    EXPECT_THAT(refused.error().message,
                HasSubstr(R"(the body must be {"user": a string, "role": one of viewer, operator, )"
                          R"(integrator, administrator (optional), "password": a string)"));
    EXPECT_EQ(refused.error().message.find("SECRET"), std::string::npos) << body;
  }
}

TEST(AccessRecords, OnlyARoleThatUsersHaveIsARole) {
  for (const char* role : {"\"nobody\"", "\"\"", "\"Viewer\"", "1"}) {
    const auto refused =
        parse_record<TokenBody>(R"({"name":"plc","role":)" + std::string(role) + "}");
    ASSERT_FALSE(refused) << role;
    EXPECT_THAT(refused.error().message, HasSubstr("role must be one of viewer, operator"));
  }
}

TEST(AccessRecords, UsersAreSentWithoutTheirSecrets) {
  Users all{{{"kim", Role::Viewer, "SECRET"}}, {{"plc", Role::Operator, "SECRET"}}};
  EXPECT_EQ(json_text(json_of(all)), R"({"users":[{"name":"kim","role":"viewer"}],)"
                                     R"("tokens":[{"name":"plc","role":"operator"}]})");
}

}  // namespace
}  // namespace orbwatch::app::web::tests
