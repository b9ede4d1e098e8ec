// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/readme/readme_commands.h"
#include "tests/readme/readme_site.h"
#include "tests/support/comes_true.h"
#include "tests/support/loopback_dds.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

/// The commands of the READMEs must run as documented.
namespace orbwatch::tests {
namespace {

constexpr std::array kPages{"README.md", "platform/INSTALL.md", "platform/README.md",
                            "app/cli/README.md", "app/cli/GUIDE.md"};

/// Commands that this test runs unchanged, and that must end with 0.
constexpr std::array<std::string_view, 13> kRun{
    "orbwatch project ball.jpg -o view.jpg --ball 2048,2048,1970 --alpha 346 --yaw 25 --h-fov 100 "
    "--size 1280x800",
    "orbwatch project --rig rig.toml --camera left=left.png --camera right=right.png --view "
    "equirectangular --size 2048x1024 -o all.png",
    "orbwatch project --help",
    "orbwatch advise --ball-diameter 100 --distance 600 --focal 35 --pixel 3.45 --sensor 1920x1080 "
    "--target-distance 400",
    "orbwatch detect ball.jpg --overlay seen.png",
    "orbwatch drift --rig rig.toml A=FOLDER",
    "orbwatch place --rig rig.toml --camera left --image left.png --tags tags.txt -o rig.toml",
    "orbwatch calibration history",
    "orbwatch list",
    "orbwatch list --appliances",
    "orbwatch doctor",
    "orbwatchd --config FILE --check",
    "orbwatch state",
};

struct NotRun {
  std::string_view text;
  std::string_view reason;
};

constexpr std::array kNotRun{
    NotRun{"./platform/demo", "builds, and runs until Ctrl-C; tests/run --all runs it"},
    NotRun{"./tests/run", "runs this test"},
    NotRun{"./platform/build-deb --suite trixie --arch arm64 --bundle",
           "root and a network; tests/run --all builds packages"},
    NotRun{"apt install ./orbwatch_*.deb", "root; tests/platform/packages/run does"},
    NotRun{"sudo apt install ./orbwatch_*.deb ./orbwatch-camera-genicam_*.deb",
           "root; tests/platform/bundle_test.py simulates it"},
    NotRun{"systemctl status orbwatch", "the service; tests/platform/packages/run has it"},
    NotRun{"sudo systemctl reload orbwatch", "as the one before"},
    NotRun{"ssh -L 8080:localhost:8080 BOARD", "another computer"},
    NotRun{"orbwatch setup --page network", "connected cameras; setup_test.cpp gives it pictures"},
    NotRun{"orbwatch subscribe --count 1 --save pictures", "a running orbwatchd; below"},
    NotRun{"orbwatchd --config machine.toml", "runs until a signal; below"},
    NotRun{"sudo orbwatch configure machine/site.toml", "root; below without sudo"},
    NotRun{"sudo orbwatch configure --confirm", "as the one before"},
    NotRun{"orbwatch setup -o machine --ball-diameter 100 --calibration colour.yaml",
           "connected cameras; tests/app/cli/setup_test.cpp gives it pictures"},
    NotRun{"orbwatch register --rig rig.toml A=a.png B=b.png",
           "pictures of a room; tests/app/cli/register_test.cpp renders them"},
    NotRun{"orbwatch bench --config machine.toml",
           "its verdict is about the computer; tests/app/cli/bench/bench_program_test.cpp"},
    NotRun{"orbwatch bench --config tests/bench/reference/site.toml", "as the one before"},
    NotRun{"orbwatch subscribe --stats", "runs until Ctrl-C; control_program_test.cpp"},
    NotRun{"orbwatch lines --safe", "GPIO lines; tests/hil"},
    NotRun{"sudo orbwatch password", "root; tests/app/cli/password_test.cpp"},
    NotRun{"sudo orbwatch password --show", "as the one before"},
    NotRun{"sudo orbwatch support -o support.tar.zst", "root; tests/app/cli/support_test.cpp"},
    NotRun{"sudo orbwatch backup -o backup.tar.zst", "root; tests/app/cli/backup_test.cpp"},
    NotRun{"sudo orbwatch restore backup.tar.zst --check", "as the one before"},
    NotRun{"sudo orbwatch restore backup.tar.zst --camera thermal=SN-4711", "as the one before"},
    NotRun{"sudo orbwatch reset --factory", "as the one before"},
    NotRun{"sudo install -D -m 644 /usr/share/orbwatch/journald.conf "
           "/etc/systemd/journald.conf.d/orbwatch.conf",
           "the journal of this computer"},
    NotRun{"sudo systemctl restart systemd-journald", "as the one before"},
    NotRun{"sudo install -d -g orbwatch -m 2775 /etc/orbwatch/NAME /etc/orbwatch/NAME/recipes",
           "the configuration of this computer"},
    NotRun{"sudo install -d -o orbwatch -g orbwatch /mnt/ssd/recordings", "another disk"},
    NotRun{"sudo systemctl edit orbwatch", "an editor"},
    NotRun{"sudo systemctl restart orbwatch", "the service of this computer"},
    NotRun{"sudo systemctl stop orbwatch", "the service of this computer"},
    NotRun{"sudo systemctl start orbwatch", "the service of this computer"},
};

std::vector<ReadmeCommand> all_commands() {
  std::vector<ReadmeCommand> all;
  for (const char* page : kPages) std::ranges::move(commands_of(page), std::back_inserter(all));
  return all;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
  if (!words.empty() && words.front() == "sudo") words.erase(words.begin());
  return words;
}

bool is_ours(const std::string& program) { return program == "orbwatch" || program == "orbwatchd"; }

/// True for the name of a command alone, as sentences mention it.
bool is_mention(const ReadmeCommand& command) {
  const auto words = words_of(command.text);
  const std::size_t names = words.size() > 1 && words[1] == "describe" ? 3 : 2;
  return command.is_inline && words.front() == "orbwatch" && words.size() <= names;
}

class Readme : public testing::Test {
 protected:
  void SetUp() override {
    setenv(
        "PATH",
        (std::filesystem::path(ORBWATCH_PROGRAM).parent_path().string() + ":" + std::getenv("PATH"))
            .c_str(),
        1);
    setenv("ORBWATCH_CONFIG", (folder / "machine.toml").c_str(), 1);
    setenv("STATE_DIRECTORY", (folder / "state").c_str(), 1);
    setenv("CYCLONEDDS_URI", loopback_dds().c_str(), 1);
  }

  /// Starts a command line in the folder.
  Subprocess start(const std::string& text, const std::string& output = "said") {
    return Subprocess({"/bin/sh", "-c", "cd " + folder.path().string() + " && exec " + text},
                      folder / output);
  }

  /// The help of the command that the words begin with.
  const std::string& help_of(const std::vector<std::string>& words) {
    std::string line = words.front();
    if (words.front() == "orbwatch") line += " " + words.at(1);
    if (words.size() > 2 && words[1] == "describe") line += " " + words[2];
    if (words.size() > 1 && words[1].starts_with('-')) line = words.front();
    std::string& text = helps_[line];
    if (!text.empty()) return text;
    Subprocess help = start(line + " --help");
    EXPECT_EQ(help.wait(), 0) << line << ": " << help.output();
    return text = help.output();
  }

  const TemporaryFolder folder;

 private:
  std::map<std::string, std::string> helps_;
};

TEST_F(Readme, EveryCommandOfABlockIsRunOrSaidWhyNot) {
  const auto is_listed = [](const std::string& text) {
    return std::ranges::count(kRun, text) + std::ranges::count(kNotRun, text, &NotRun::text) == 1;
  };
  const auto commands = all_commands();
  EXPECT_GT(commands.size(), 40U);
  for (const ReadmeCommand& command : commands) {
    EXPECT_TRUE(is_mention(command) || is_listed(command.text))
        << command.place << ": neither in kRun nor, with a reason, in kNotRun: " << command.text;
  }
  const auto is_told = [&](std::string_view text) {
    return std::ranges::count(commands, text, &ReadmeCommand::text) > 0;
  };
  for (const std::string_view text : kRun) EXPECT_TRUE(is_told(text)) << "in no README: " << text;
  for (const NotRun& entry : kNotRun) {
    EXPECT_TRUE(is_told(entry.text)) << "in no README: " << entry.text;
  }
}

TEST_F(Readme, OurProgramsKnowTheOptions) {
  for (const ReadmeCommand& command : all_commands()) {
    const auto words = words_of(command.text);
    if (!is_ours(words.front())) continue;
    const std::string& help = help_of(words);
    for (const std::string& word : words) {
      if (word.size() < 2 || word.front() != '-') continue;
      const std::string name = word.substr(0, word.find('='));
      EXPECT_TRUE(std::regex_search(help, std::regex("(^|[^-a-z])" + name + "([^-a-z]|$)")))
          << command.place << ": " << command.text << " has no " << name;
    }
  }
}

TEST_F(Readme, TheCommandsRun) {
  write_readme_files(folder.path());
  Subprocess service = start("orbwatchd --config machine.toml", "log");
  for (const std::string_view text : kRun) {
    Subprocess command = start(std::string(text));
    EXPECT_EQ(command.wait(), 0) << text << ": " << command.output();
  }
  Subprocess trial = start("orbwatch configure machine/site.toml");  // the service restarts for it
  EXPECT_EQ(trial.wait(), 0) << trial.output();
  Subprocess subscriber = start("orbwatch subscribe --count 1 --save pictures");
  EXPECT_EQ(subscriber.wait(), 0) << subscriber.output();
  EXPECT_TRUE(comes_true([&] {
    Subprocess confirmation = start("orbwatch configure --confirm");
    return confirmation.wait() == 0;
  })) << service.output();
  for (const char* made : {"view.jpg", "all.png", "seen.png", "pictures"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / made)) << made;
  }
  EXPECT_FALSE(std::filesystem::is_empty(folder / "pictures"));
  service.send(SIGTERM);
  EXPECT_EQ(service.wait(), 0) << service.output();
}

}  // namespace
}  // namespace orbwatch::tests
