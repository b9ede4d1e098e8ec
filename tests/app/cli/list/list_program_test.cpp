// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"

/// Runs `orbwatch list` like a user, on the machine of the test.
namespace orbwatch::tests {
namespace {

class List : public CommandLine {};

TEST_F(List, PrintsBothKindsInBothForms) {
  EXPECT_EQ(run({"list", "--json"}), 0);
  const auto inventory = nlohmann::json::parse(said, nullptr, false);
  EXPECT_TRUE(inventory.contains("cameras") && inventory["cameras"].is_array()) << said;
  EXPECT_TRUE(inventory.contains("chips") && inventory["chips"].is_array()) << said;
  EXPECT_EQ(run({"list", "--help"}), 0);
  expect_documented(inventory, said);
  EXPECT_EQ(run({"list"}), 0);
  EXPECT_FALSE(said.empty());
  EXPECT_EQ(said.find('{'), std::string::npos) << said;
}

TEST_F(List, RefusesWhatItDoesNotKnow) {
  expect_refused("list", {"Argument", {"cameras"}, {"cameras", "--help"}});
  expect_refused("list", {"Option", {"--yaml"}, {"--yaml"}});
}

}  // namespace
}  // namespace orbwatch::tests
