#include "tests/app/cli/command_line.h"

/// `orbwatch list` as a user runs it, on whatever machine this is.
namespace orbwatch::tests {
namespace {

class List : public CommandLine {};

TEST_F(List, PrintsBothKindsInBothForms) {
  EXPECT_EQ(run({"list", "--json"}), 0);
  EXPECT_EQ(said.find("{\"cameras\": ["), 0U) << said;
  EXPECT_NE(said.find("\"chips\": ["), std::string::npos) << said;
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
