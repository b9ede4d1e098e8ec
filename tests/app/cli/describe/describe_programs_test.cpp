// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

/// Manual page and completion are generated from the declarations of the commands.
namespace orbwatch::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::filesystem::path kFolder =
    std::filesystem::path(ORBWATCH_SOURCE_DIR) / "app/cli/describe";

std::string output_of(const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  Subprocess program(arguments, folder / "output");
  EXPECT_EQ(program.wait(), 0) << program.output();
  return program.output();
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Completions that bash offers for these words, the last of which is incomplete.
std::string offered(const std::string& words) {
  return output_of({"/bin/bash", "-c",
                    "source " + (kFolder / "orbwatch.bash").string() + "; COMP_WORDS=(" + words +
                        "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _orbwatch; "
                        "printf '%s ' \"${COMPREPLY[@]}\""});
}

TEST(DescribePrograms, TheCommittedFilesAreFresh) {
  EXPECT_EQ(output_of({ORBWATCH_PROGRAM, "describe", "man"}), text_of(kFolder / "orbwatch.1"))
      << "orbwatch describe man > app/cli/describe/orbwatch.1";
  EXPECT_EQ(output_of({ORBWATCH_PROGRAM, "describe", "completion"}),
            text_of(kFolder / "orbwatch.bash"))
      << "orbwatch describe completion > app/cli/describe/orbwatch.bash";
}

TEST(DescribePrograms, TheManualPageHasEveryOption) {
  const std::string page = text_of(kFolder / "orbwatch.1");
  for (const char* part : {".SS \"configure\"", "\\-\\-confirm", ".SS \"describe view\"",
                           "\\-\\-size\\-of\\-picture", "EXIT STATUS", "ORBWATCH_CONFIG"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
}

TEST(DescribePrograms, TheServicesPageHasItsHelp) {
  std::string page = text_of(std::filesystem::path(ORBWATCH_SOURCE_DIR) / "app/daemon/orbwatchd.8");
  std::erase(page, '\\');
  EXPECT_THAT(page, HasSubstr(output_of({ORBWATCHD_PROGRAM, "--help"})));
}

TEST(DescribePrograms, BashOffersCommandsAndTheirOptions) {
  EXPECT_THAT(offered("orbwatch con"), HasSubstr("configure"));
  EXPECT_EQ(offered("orbwatch configure --con"), "--config --confirm ");
  EXPECT_THAT(offered("orbwatch describe rec"), HasSubstr("recipe"));
  EXPECT_THAT(offered("orbwatch describe view --"), HasSubstr("--size-of-picture"));
  EXPECT_THAT(offered("orbwatch command sel"), HasSubstr("select_view"));
  EXPECT_THAT(offered("orbwatch list --"), Not(HasSubstr("--ball")));
}

}  // namespace
}  // namespace orbwatch::tests
