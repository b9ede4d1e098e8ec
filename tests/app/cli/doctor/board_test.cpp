// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/app/health/made_up_tree.h"

namespace orbwatch::app::cli::doctor {
namespace {

using testing::HasSubstr;
using tests::MadeUpTree;

constexpr const char* kBoard = R"(
name = "Board"
models = ["Acme Board"]
tried = "nothing"
slows_down_at = 80

[[line]]
names = ["A1", "A2"]
volt = 3.3
pull = "up"
)";

std::filesystem::path shipped() {
  return std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/boards";
}

TEST(Boards, TheShippedFilesAreRight) {
  std::vector<std::string> problems;
  const auto boards = read_boards(shipped(), problems);
  EXPECT_TRUE(problems.empty()) << problems.front();
  EXPECT_EQ(boards.size(), 7U);
  for (const Board& board : boards) {
    EXPECT_FALSE(board.tried.empty()) << board.name;
    EXPECT_NE(board.models.empty(), board.architecture.empty()) << board.name;
    std::set<std::string> names;
    for (const BoardLines& lines : board.lines) {
      for (const std::string& name : lines.names) EXPECT_TRUE(names.insert(name).second) << name;
    }
  }
}

TEST(Boards, AreKnownByHowTheyCallThemselves) {
  std::vector<std::string> problems;
  const auto boards = read_boards(shipped(), problems);
  const auto name_of = [&](const char* model, const char* architecture = "aarch64") {
    const Board* const board = find_board(boards, model, architecture);
    return board != nullptr ? board->name : "none";
  };
  EXPECT_EQ(name_of("Raspberry Pi 4 Model B Rev 1.5"), "Raspberry Pi 4 Model B");
  EXPECT_EQ(name_of("Raspberry Pi 5 Model B Rev 1.0"), "Raspberry Pi 5");
  EXPECT_EQ(name_of("Raspberry Pi Compute Module 4 Rev 1.1"), "Raspberry Pi Compute Module 4");
  EXPECT_EQ(name_of("Raspberry Pi Compute Module 5 Rev 1.0"), "Raspberry Pi Compute Module 5");
  EXPECT_EQ(name_of("PHYTEC phyBOARD-Pollux i.MX8MP"), "PHYTEC phyBOARD-Pollux i.MX8MP");
  EXPECT_EQ(name_of("Radxa ROCK 5B"), "any arm64 board");
  EXPECT_EQ(name_of("Acme Box 7", "x86_64"), "any x86 PC");
  EXPECT_EQ(name_of("Acme Box 7", "riscv64"), "none");
  EXPECT_EQ(name_of("", ""), "none");
}

TEST(Boards, OfAComputeModuleHaveWhatItsChipHas) {
  const auto module = read_board(shipped() / "raspberry-pi-cm4.toml");
  ASSERT_TRUE(module) << module.error().message;
  EXPECT_EQ(module->slows_down_at, 80);
  ASSERT_TRUE(find_lines(*module, "GPIO17"));
  EXPECT_EQ(find_lines(*module, "GPIO17")->pull, Pull::Down);
  EXPECT_EQ(find_lines(*module, "GPIO5")->pull, Pull::Up);
  EXPECT_EQ(find_lines(*module, "GPIO99"), nullptr);
  ASSERT_TRUE(find_camera(*module, "/base/soc/i2c0mux/i2c@1/imx296@1a"));
  EXPECT_EQ(find_camera(*module, "imx296")->trigger_volt, 1.8);
  EXPECT_EQ(find_camera(*module, "imx999"), nullptr);
}

TEST(Boards, TheLongestBeginningCounts) {
  const std::vector<Board> boards{{.name = "long", .models = {"Acme Board Plus"}},
                                  {.name = "short", .models = {"Acme"}}};
  EXPECT_EQ(find_board(boards, "Acme Board Plus 2", "")->name, "long");
  EXPECT_EQ(find_board(boards, "Acme Board", "")->name, "short");
}

TEST(Boards, LikeAddsToAnotherAndReplacesItsKeys) {
  MadeUpTree tree;
  tree.write("board.toml", kBoard);
  tree.write("other.toml", R"(
like = "board"
name = "Other"
models = ["Acme Other"]
tried = "nothing"
[[line]]
names = ["B1"]
volt = 5
)");
  const auto other = read_board(tree / "other.toml");
  ASSERT_TRUE(other) << other.error().message;
  EXPECT_EQ(other->name, "Other");
  EXPECT_EQ(other->models, std::vector<std::string>{"Acme Other"});
  EXPECT_EQ(other->slows_down_at, 80);
  EXPECT_EQ(find_lines(*other, "A2")->volt, 3.3);
  EXPECT_EQ(find_lines(*other, "B1")->volt, 5);
}

TEST(Boards, WrongFilesAreNamedAndTheOthersRead) {
  MadeUpTree tree;
  tree.write("board.toml", kBoard);
  tree.write("1.toml", "name = 7\n");
  tree.write("2.toml", std::string(kBoard) + "[[line]]\nnames = [\"B\"]\nvolt = 1e99\n");
  tree.write("3.toml", "like = \"../secret\"\nname = \"A\"\ntried = \"B\"\n");
  tree.write("4.toml", "like = \"5\"\nname = \"A\"\ntried = \"B\"\n");
  tree.write("5.toml", "like = \"4\"\nname = \"A\"\ntried = \"B\"\n");
  tree.write("6.toml", std::string("\0\xff[[[", 5));
  tree.write("notes.txt", "no board");
  tree.make_folder("folder.toml");
  std::vector<std::string> problems;
  EXPECT_EQ(read_boards(tree.path(), problems).size(), 1U);
  ASSERT_EQ(problems.size(), 6U);
  EXPECT_THAT(problems[0], HasSubstr("1.toml:1: name"));
  EXPECT_THAT(problems[1], HasSubstr("volt"));
  EXPECT_THAT(problems[2], HasSubstr("like"));
  EXPECT_THAT(problems[3], HasSubstr("like another"));
  EXPECT_TRUE(read_boards(tree / "none", problems).empty());
}

}  // namespace
}  // namespace orbwatch::app::cli::doctor
