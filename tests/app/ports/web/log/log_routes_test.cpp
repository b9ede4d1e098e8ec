// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/log/log_routes.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/model/status/utc_text.h"
#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

class Log : public Served {
 protected:
  void SetUp() override {
    const auto log = std::make_shared<RecentLog>();
    log->add({LogLevel::Info, "runs", {}});
    log->add({LogLevel::Warning, "late", {.camera = "thermal", .fault = "stalled", .trigger = 7}});
    log->add({LogLevel::Error, "no file \xFF", {}});
    program.log = log;
    start();
  }
  std::vector<int> numbers(const std::string& query) const {
    const Answer answer = get(port(), "/api/v1/log" + query);
    EXPECT_EQ(answer.status, 200) << answer.body;
    std::vector<int> numbers;
    const json all = json::parse(answer.body);
    for (const auto& line : all["lines"]) numbers.push_back(line["number"]);
    return numbers;
  }
};

TEST_F(Log, IsReadAsJson) {
  const json lines = json::parse(get(port(), "/api/v1/log").body)["lines"];
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0]["level"], "info");
  EXPECT_EQ(lines[0]["text"], "runs");
  EXPECT_FALSE(lines[0].contains("camera"));
  EXPECT_THAT(lines[0]["time"].get<std::string>(), testing::StartsWith("20"));
  EXPECT_EQ(lines[1]["camera"], "thermal");
  EXPECT_EQ(lines[1]["fault"], "stalled");
  EXPECT_EQ(lines[1]["trigger"], 7);
  EXPECT_EQ(lines[2]["text"], "no file \xEF\xBF\xBD") << "bytes that are no UTF-8";
}

TEST_F(Log, StatesTheStartFromWhichItsLinesAreCounted) {
  const std::string started = utc_text(program.log->started()).value();
  EXPECT_EQ(json::parse(get(port(), "/api/v1/log").body)["started"], started);
  EXPECT_EQ(json::parse(get(port(), "/api/v1/log?after=3").body)["started"], started);
}

TEST_F(Log, IsFiltered) {
  EXPECT_THAT(numbers("?lines=2"), ElementsAre(2, 3));
  EXPECT_THAT(numbers("?level=warning"), ElementsAre(2, 3));
  EXPECT_THAT(numbers("?level=error&lines=5"), ElementsAre(3));
  EXPECT_EQ(json::parse(get(port(), "/api/v1/log?level=error").body)["newest"], 3);
  EXPECT_THAT(numbers("?after=2"), ElementsAre(3));
  EXPECT_THAT(numbers("?lines=0"), ElementsAre());
}

TEST_F(Log, RefusesOtherArguments) {
  for (const char* query : {"?lines=-1", "?lines=", "?lines=1x", "?after=x",
                            "?after=18446744073709551616", "?level=debug"}) {
    const Answer answer = get(port(), "/api/v1/log" + std::string(query));
    EXPECT_EQ(answer.status, 400) << query;
    EXPECT_THAT(answer.body, HasSubstr(" must be ")) << query;
  }
}

TEST_F(Served, WithoutALogThereAreNoLines) {
  start();
  const Answer answer = get(port(), "/api/v1/log");
  EXPECT_EQ(answer.status, 404);
  EXPECT_THAT(answer.body, HasSubstr("keeps no lines"));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
