// SPDX-License-Identifier: Apache-2.0
#include "app/exit_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

/// Exit statuses of the programs, and their documentation in help and manual pages.
namespace orbwatch::tests {
namespace {

using app::ExitStatus;
using testing::HasSubstr;
using Words = std::vector<std::string>;

class ExitStatuses : public testing::Test {
 protected:
  ExitStatus run(Words arguments, const char* program = ORBWATCH_PROGRAM) {
    arguments.insert(arguments.begin(), program);
    Subprocess process(arguments, folder / "said");
    const int code = process.wait();
    said = process.output();
    return static_cast<ExitStatus>(code);
  }

  /// First words of the lines in which the program's help names its commands.
  Words commands() {
    EXPECT_EQ(run({"help"}), ExitStatus::Done);
    static const std::regex kCommand("\n  ([a-z][a-z-]+) ");
    Words names;
    for (std::sregex_iterator it(said.begin(), said.end(), kCommand), end; it != end; ++it) {
      names.push_back((*it)[1]);
    }
    return names;
  }

  /// Text of a manual page without escapes.
  static std::string page(const char* file) {
    std::ifstream in(std::filesystem::path(ORBWATCH_SOURCE_DIR) / file);
    std::ostringstream text;
    text << in.rdbuf();
    std::string page = text.str();
    std::erase(page, '\\');
    return page;
  }

  static std::string number(const app::ExitStatusInfo& info) {
    return std::to_string(static_cast<int>(info.status));
  }

  const TemporaryFolder folder;
  std::string said;
};

TEST_F(ExitStatuses, EveryCommandEndsWellWithItsHelp) {
  const Words names = commands();
  EXPECT_GT(names.size(), 15U);
  for (const std::string& name : names) {
    EXPECT_EQ(run({name, "--help"}), ExitStatus::Done) << name;
    EXPECT_THAT(said, HasSubstr("Usage: orbwatch " + name));
  }
}

TEST_F(ExitStatuses, NoCommandTakesWhatItDoesNotKnow) {
  for (const std::string& name : commands()) {
    EXPECT_EQ(run({name, "--no-such-option"}), ExitStatus::WrongUsage) << name << ": " << said;
    EXPECT_THAT(said, HasSubstr("see --help"));
  }
}

TEST_F(ExitStatuses, MissingAndContradictingArgumentsAreWrongUsage) {
  const std::vector<Words> mistakes{
      {},
      {"paint"},
      {"describe", "weather"},
      {"describe", "camera", "--rig", "rig.toml"},
      {"detect"},
      {"drift", "--rig", "rig.toml", "A"},
      {"register", "A=a.png"},
      {"place", "--camera", "A"},
      {"project", "ball.png"},
      {"project", "ball.png", "-o", "out.png", "--ball", "1,2"},
      {"project", "ball.png", "-o", "out.png", "--rig", "rig.toml"},
      {"setup", "-o", "site"},
      {"configure", "site.toml", "--confirm"},
      {"configure", "site.toml", "--seconds", "5"},
      {"configure", "--confirm", "--dry-run"},
      {"configure", "--cancel", "--seconds", "30"},
      {"restore", "--undo", "--check"},
      {"restore", "--pending", "--at-start"},
      {"bench", "--seconds", "0"},
      {"calibration", "restore", "first"},
      {"command", "explode"},
      {"command", "select_recipe", "0"},
      {"lines"},
      {"password", "one", "two"},
      {"dds-keys"},
      {"state", "--timeout", "0"},
      {"advise", "--ball-diameter", "100"},
  };
  for (const Words& words : mistakes) {
    EXPECT_EQ(run(words), ExitStatus::WrongUsage) << testing::PrintToString(words) << said;
  }
}

TEST_F(ExitStatuses, WhatCannotBeDoneFails) {
  const std::string none = (folder / "none").string();
  const std::vector<Words> failures{
      {"detect", none + ".png"},
      {"drift", "--rig", none, "A=" + none},
      {"register", "--rig", none, "A=a.png", "B=b.png"},
      {"place", "--rig", none, "--camera", "A"},
      {"project", none + ".png", "-o", none + ".jpg", "--ball", "9,9,5", "--alpha", "340"},
      {"describe", "camera", "--rig", none, "--camera", "A"},
      {"setup", "-o", none, "--ball-diameter", "100", "--camera", none},
      {"configure", none, "--dry-run"},
      {"bench", "--config", none},
      {"calibration", "history", "--config", none},
      {"lines", "--safe", "--config", none},
      {"password", "--config", none},
      {"doctor", "--config", none},
  };
  for (const Words& words : failures) {
    EXPECT_EQ(run(words), ExitStatus::Failed) << testing::PrintToString(words) << said;
  }
}

TEST_F(ExitStatuses, OfTheService) {
  const std::string demo = std::string(ORBWATCH_SOURCE_DIR) + "/platform/config/demo.toml";
  EXPECT_EQ(run({"--config", demo, "--check"}, ORBWATCHD_PROGRAM), ExitStatus::Done) << said;
  EXPECT_EQ(run({"--config", (folder / "none").string(), "--check"}, ORBWATCHD_PROGRAM),
            ExitStatus::Failed);
  EXPECT_EQ(run({"--no-such-option"}, ORBWATCHD_PROGRAM), ExitStatus::WrongUsage);
  EXPECT_EQ(run({"site.toml"}, ORBWATCHD_PROGRAM), ExitStatus::WrongUsage);
}

TEST_F(ExitStatuses, HelpAndManualPagesHaveThem) {
  ASSERT_EQ(run({"help"}), ExitStatus::Done);
  const std::string orbwatch = page("app/cli/describe/orbwatch.1");
  const std::string orbwatchd = page("app/daemon/orbwatchd.8");
  std::string section = ".SH EXIT STATUS\n", section_of_service = section;
  for (const app::ExitStatusInfo& info : app::kExitStatuses) {
    if (!info.of_orbwatch.empty()) {
      EXPECT_THAT(said, HasSubstr(number(info) + "  " + std::string(info.of_orbwatch) + "\n"));
      section += ".TP\n" + number(info) + "\n" + std::string(info.of_orbwatch) + "\n";
    }
    section_of_service += ".TP\n" + number(info) + "\n" + std::string(info.of_orbwatchd) + "\n";
  }
  EXPECT_THAT(orbwatch, HasSubstr(section + ".SH"));
  EXPECT_THAT(orbwatchd, HasSubstr(section_of_service + ".SH"));
}

}  // namespace
}  // namespace orbwatch::tests
