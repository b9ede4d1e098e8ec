// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/commands/command_body.h"

#include <gmock/gmock.h>

#include <string>

namespace orbwatch::app::web {
namespace {

using testing::HasSubstr;

const CommandInfo& kPoint = *find_command(CommandCode::PointView);
const CommandInfo& kStart = *find_command(CommandCode::Start);

TEST(CommandBody, HasEachArgumentByItsName) {
  const auto command =
      parse_command(kPoint, R"({"h_fov": 60.5, "yaw": -10, "pitch": 1e1, "view": 2})");
  ASSERT_TRUE(command) << command.error().message;
  EXPECT_EQ(command->code, CommandCode::PointView);
  EXPECT_EQ(command->arguments, (std::array<double, kMaxArguments>{2, -10, 10, 60.5}));
}

TEST(CommandBody, MayBeEmptyWithoutArguments) {
  EXPECT_TRUE(parse_command(kStart, ""));
  EXPECT_TRUE(parse_command(kStart, "{}"));
  EXPECT_FALSE(parse_command(kPoint, ""));
}

TEST(CommandBody, IsRefusedWithWhatWouldBeRight) {
  const auto refusal = [](const CommandInfo& info, const std::string& body) {
    const auto command = parse_command(info, body);
    return command ? "accepted" : command.error().message;
  };
  const std::string form = R"("yaw": -180 to 180 deg)";
  for (const char* body :
       {"x", "[]", "7", "null", "{", R"({"view": 0})", "\xff\xfe", R"({"view":0}{"view":0})",
        R"({"view": 0, "yaw": 0, "pitch": 0, "fov": 0})",
        R"({"view": 0, "yaw": "0", "pitch": 0, "h_fov": 0})",
        R"({"view": 0, "yaw": null, "pitch": 0, "h_fov": 0})",
        R"({"view": 0, "yaw": true, "pitch": 0, "h_fov": 0})",
        R"({"view": 0, "yaw": 0, "pitch": 0, "h_fov": 0, "more": 0})"}) {
    EXPECT_THAT(refusal(kPoint, body), HasSubstr(form)) << body;
  }
  EXPECT_THAT(refusal(kPoint, R"({"view": 0, "yaw": 200, "pitch": 0, "h_fov": 0})"),
              HasSubstr("yaw is 200; it must be -180 to 180 deg"));
  EXPECT_THAT(refusal(kPoint, R"({"view": 0.5, "yaw": 0, "pitch": 0, "h_fov": 0})"),
              HasSubstr("view is 0.5; it must be a whole number"));
  EXPECT_THAT(refusal(kPoint, R"({"view": 1e400, "yaw": 0, "pitch": 0, "h_fov": 0})"),
              HasSubstr(form));
  EXPECT_THAT(refusal(kStart, R"({"view": 0})"), HasSubstr("unknown member; the body must be {}"));
}

TEST(CommandBody, MayBeNestedDeeply) {
  const std::string deep = std::string(60000, '[') + std::string(60000, ']');
  EXPECT_FALSE(parse_command(kPoint, deep));
  EXPECT_FALSE(parse_command(kPoint, std::string(60000, '[')));
  EXPECT_FALSE(parse_command(kPoint, "{\"view\":" + deep + "}"));
}

}  // namespace
}  // namespace orbwatch::app::web
