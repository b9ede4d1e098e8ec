// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"

/// Runs `orbwatch advise` like a user.
namespace orbwatch::tests {
namespace {

const std::vector<std::string> kSetUp{"--ball-diameter", "100",       "--distance",        "600",
                                      "--focal",         "25",        "--pixel",           "3.45",
                                      "--sensor",        "1920x1080", "--target-distance", "400"};

class Advise : public CommandLine {
 protected:
  int advise(std::vector<std::string> more = {}) {
    more.insert(more.begin(), kSetUp.begin(), kSetUp.end());
    more.insert(more.begin(), "advise");
    return run(more);
  }
};

TEST_F(Advise, PrintsATableAndWhatToChange) {
  ASSERT_EQ(advise({"--smallest", "0.1"}), 0) << said;
  for (const char* part :
       {"alpha            350.44 deg", "depth of field", "px per mm", "Change: "}) {
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }
}

TEST_F(Advise, PrintsTheSameForPrograms) {
  ASSERT_EQ(advise({"--json"}), 0) << said;
  const auto json = nlohmann::json::parse(said);
  EXPECT_NEAR(json["alpha"].get<double>(), 350.4396, 1e-3);
  EXPECT_EQ(json["sights"].size(), 5U);
  EXPECT_GT(json["sights"][0]["pixels_per_degree"], json["sights"][4]["pixels_per_degree"]);
  EXPECT_FALSE(json["changes"].empty());
  ASSERT_EQ(run({"advise", "--help"}), 0);
  expect_documented(json, said);
}

TEST_F(Advise, RefusesMistakesWithTheReason) {
  for (const Mistake& mistake : {
           Mistake{"nothing", {}, {"ball's diameter", "--help"}},
           Mistake{"no number", {"--focal", "long"}, {"focal", "long"}},
           Mistake{"no size", {"--sensor", "1920"}, {"sensor", "1920"}},
           Mistake{"a word", {"ball"}, {"ball"}},
       }) {
    SCOPED_TRACE(mistake.name);
    expect_refused("advise", mistake);
  }
}

}  // namespace
}  // namespace orbwatch::tests
