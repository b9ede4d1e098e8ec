// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

/// The table of commands in tests/README.md is complete and true.
namespace orbwatch::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ORBWATCH_SOURCE_DIR;

/// A row of the table: `tests/run --changed [BASE]`.
struct Row {
  std::string command;
  std::string script;                ///< from the project's root
  std::vector<std::string> options;  ///< "--changed"
};

std::vector<Row> rows() {
  static const std::regex kRow("\\| `([^`]+)` \\|.*");
  static const std::regex kOption("--[a-z-]+");
  std::vector<Row> found;
  std::ifstream in(kRoot / "tests/README.md");
  EXPECT_TRUE(in);
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, kRow)) continue;
    const std::string command = match[1];
    Row row{command, command.substr(0, command.find(' ')), {}};
    for (std::sregex_iterator it(command.begin(), command.end(), kOption), end; it != end; ++it) {
      row.options.push_back(it->str());
    }
    found.push_back(row);
  }
  return found;
}

bool is_program(const fs::path& file) {
  const auto status = fs::status(file);
  return fs::is_regular_file(status) &&
         (status.permissions() & fs::perms::owner_exec) != fs::perms::none;
}

/// The scripts that a developer starts: those in tests/ and tests/bench/ itself, and each that is
/// named run.
std::set<std::string> scripts() {
  const fs::path tests = kRoot / "tests";
  std::set<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(tests)) {
    const fs::path& file = entry.path();
    const bool is_started = file.parent_path() == tests || file.parent_path() == tests / "bench" ||
                            file.filename() == "run";
    if (is_started && file.extension().empty() && is_program(file)) {
      found.insert(fs::relative(file, kRoot).string());
    }
  }
  return found;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A script that does not know the option would begin its work.
bool knows_help(const fs::path& script) {
  const std::string text = text_of(script);
  return text.find("--help") != std::string::npos || text.find("argparse") != std::string::npos;
}

TEST(Commands, EachScriptHasOneRow) {
  std::map<std::string, int> plain;
  std::set<std::string> commands;
  for (const Row& row : rows()) {
    EXPECT_TRUE(commands.insert(row.command).second) << row.command << " has two rows";
    if (row.options.empty()) ++plain[row.script];
  }
  const auto all = scripts();
  EXPECT_GT(all.size(), 10U);
  for (const std::string& script : all) {
    EXPECT_EQ(plain[script], 1) << "rows of " << script << " in tests/README.md";
  }
}

TEST(Commands, EachRowIsAnsweredByHelp) {
  const TemporaryFolder folder;
  for (const Row& row : rows()) {
    const fs::path script = kRoot / row.script;
    if (!is_program(script) || !knows_help(script)) {
      ADD_FAILURE() << row.script << " is not a script that knows --help";
      continue;
    }
    Subprocess help({script.string(), "--help"}, folder / "said");
    EXPECT_EQ(help.wait(), 0) << row.script << ": " << help.output();
    EXPECT_THAT(help.output(), testing::HasSubstr(script.filename().string())) << row.script;
    for (const std::string& option : row.options) {
      EXPECT_THAT(help.output(), testing::HasSubstr(option)) << row.command;
    }
  }
}

}  // namespace
}  // namespace orbwatch::tests
