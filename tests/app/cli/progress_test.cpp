// SPDX-License-Identifier: Apache-2.0
#include "app/cli/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "app/log.h"
#include "tests/app/cli/command_line.h"
#include "tests/proc/align/detect/painted_ball.h"
#include "tests/support/pseudo_terminal.h"

/// Progress is shown to users on a terminal, but not to programs.
namespace orbwatch::tests {
namespace {

using app::cli::Progress;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ProgressLine, IsRewrittenAndErased) {
  PseudoTerminal terminal;
  {
    Progress progress(terminal.program_side());
    progress.begin("matching features");
    progress.begin("matching edges");
    progress.count("watching", 3, 12, "pictures");
  }
  EXPECT_THAT(rewritten_lines(terminal.read_to_end()),
              ElementsAre("", "matching features ...", "matching edges ...",
                          "watching: 3 of 12 pictures", ""));
}

TEST(ProgressLine, OfManyStepsShowsFew) {
  PseudoTerminal terminal;
  constexpr std::size_t kMany = 1000;
  {
    Progress progress(terminal.program_side());
    for (std::size_t n = 1; n <= kMany; ++n) progress.count("watching", n, kMany, "pictures");
  }
  const auto lines = rewritten_lines(terminal.read_to_end());
  EXPECT_GE(lines.size(), 3U);
  EXPECT_LT(lines.size(), kMany / 2);
  EXPECT_EQ(lines[1], "watching: 1 of 1000 pictures");
  EXPECT_EQ(lines.back(), "");
}

TEST(ProgressLine, IsAsWideAsTheTerminalAndHarmless) {
  PseudoTerminal terminal(20);
  {
    Progress progress(terminal.program_side());
    progress.begin("looking for \x1b[2J in a very long name");
  }
  EXPECT_THAT(rewritten_lines(terminal.read_to_end()), ElementsAre("", "looking for ?[2J in", ""));
}

TEST(ProgressLine, MakesRoomForTheLog) {
  PseudoTerminal terminal;
  const hal::FileDescriptor usual(dup(STDERR_FILENO));
  ASSERT_EQ(dup2(terminal.program_side(), STDERR_FILENO), STDERR_FILENO);
  {
    Progress progress;
    progress.begin("waiting for the first frames");
    app::log_line(app::LogLevel::Warning, "camera A: slow");
    progress.begin("measuring");
  }
  ASSERT_EQ(dup2(usual.get(), STDERR_FILENO), STDERR_FILENO);
  EXPECT_THAT(rewritten_lines(terminal.read_to_end()),
              ElementsAre("", "waiting for the first frames ...", "orbwatch: camera A: slow", "",
                          "measuring ...", ""));
}

TEST(ProgressLine, IsNotWrittenWhereNobodyLooks) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const hal::FileDescriptor reader(ends[0]);
  {
    const hal::FileDescriptor writer(ends[1]);
    Progress progress(writer.get());
    progress.begin("matching edges");
    progress.count("watching", 3, 12, "pictures");
  }
  char byte = 0;
  EXPECT_EQ(read(reader.get(), &byte, 1), 0);
}

class ProgressOf : public CommandLine {
 protected:
  ProgressOf() {
    const cv::Mat ball = align::painted_ball({400, 320}, {{202.3, 161.7}, 115, 115, 0});
    write("ball.png", ball);
    std::filesystem::create_directory(path("pictures"));
    for (int n = 0; n < 8; ++n) write("pictures/" + std::to_string(n) + ".png", ball);
    std::string rig;
    for (const char* name : {"A", "B"}) {
      rig += "[[camera]]\nname = \"" + std::string(name) +
             "\"\nwidth = 400\nheight = 320\n[camera.intrinsics]\nfx = 900\nfy = 900\n"
             "cx = 199.5\ncy = 159.5\n[camera.outline]\ncentre = [202.3, 161.7]\n"
             "radii = [115, 115]\n";
    }
    write("rig.toml", rig);
  }

  /// Lines that a terminal shows on standard error while the program runs; its output goes to a
  /// file.
  std::vector<std::string> seen_by_people(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), ORBWATCH_PROGRAM);
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    PseudoTerminal terminal;
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, path("output").c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&files, terminal.program_side(), STDERR_FILENO);
    pid_t pid = 0;
    EXPECT_EQ(posix_spawn(&pid, argv[0], &files, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&files);
    const auto lines = rewritten_lines(terminal.read_to_end());
    int status = 0;
    EXPECT_EQ(waitpid(pid, &status, 0), pid);
    return lines;
  }

  /// Checks that progress is shown and erased on a terminal, and not written without one.
  void expect_progress(const std::vector<std::string>& arguments, const std::string& step) {
    const auto lines = seen_by_people(arguments);
    EXPECT_THAT(lines, Contains(StartsWith(step)));
    EXPECT_EQ(lines.back(), "") << "it stays on the terminal";
    EXPECT_EQ(run(arguments), 0) << said;
    EXPECT_EQ(said.find('\r'), std::string::npos) << said;
    EXPECT_EQ(said.find(step), std::string::npos) << said;
  }
};

TEST_F(ProgressOf, Detect) {
  expect_progress({"detect", path("ball.png")}, "looking for the ball in ball.png ...");
}

TEST_F(ProgressOf, Drift) {
  expect_progress({"drift", "--rig", path("rig.toml"), "A=" + path("pictures")},
                  "watching: 1 of 8 pictures");
}

TEST_F(ProgressOf, Project) {
  expect_progress({"project", path("ball.png"), "-o", path("view.png"), "--rig", path("rig.toml"),
                   "--camera", "A"},
                  "making the view ...");
}

TEST_F(ProgressOf, Setup) {
  expect_progress({"setup", "-o", path("site"), "--force", "--ball-diameter", "80", "--camera",
                   "A=" + path("ball.png")},
                  "looking for the ball of A ...");
}

TEST_F(ProgressOf, Register) {
  expect_progress(
      {"register", "--rig", path("rig.toml"), "A=" + path("ball.png"), "B=" + path("ball.png")},
      "matching features ...");
}

TEST_F(ProgressOf, Place) {
  // The points are arbitrary: they are placed, or contradict each other.
  const auto lines = seen_by_people({"place", "--rig", path("rig.toml"), "--camera", "A", "--point",
                                     "150,120=900,0,500", "--point", "250,160=-900,100,400",
                                     "--point", "200,220=100,800,-300"});
  EXPECT_THAT(lines, Contains("placing the cameras ..."));
}

TEST_F(ProgressOf, Bench) {
  const std::string demo = std::string(ORBWATCH_SOURCE_DIR) + "/platform/config/demo.toml";
  const auto lines = seen_by_people({"bench", "--config", demo, "--simulated", "--seconds", "2"});
  EXPECT_THAT(lines, Contains("waiting for the first frames ..."));
  EXPECT_THAT(lines, Contains("measuring: 1 of 2 s"));
}

}  // namespace
}  // namespace orbwatch::tests
