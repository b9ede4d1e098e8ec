// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/model/command/command.h"
#include "app/model/status/status.h"
#include "tests/app/daemon/daemon_program.h"

/// Recipes, results, snapshots and restarts commanded by a PLC.
namespace orbwatch::tests {
namespace {

using app::CommandCode;
using app::CommandResult;

/// Recipe that measures the sparks of the whole view, in a view of another size.
const std::string kSecondRecipe = R"(
name = "all"
[[view]]
name = "wide"
measured = "thermal"
yaw = -115
pitch = -40
h_fov = 110
width = 120
height = 90
[[view.source]]
camera = "thermal"
[[region]]
name = "all"
view = "wide"
hot_spot_threshold = 900
[[region]]
name = "hottest"
view = "wide"
hot_spot_threshold = 1900
)";

constexpr const char* kSecond = "[[recipe]]\nnumber = 2\nfile = \"second.toml\"\n";

std::string with_control(const std::string& recipe, const std::string& name, double value) {
  return recipe + "[[control]]\ncamera = \"thermal\"\nname = \"" + name +
         "\"\nvalue = " + std::to_string(value) + "\n";
}

class RecipeCommands : public Daemon {
 protected:
  void write_second(const std::string& text) const {
    std::ofstream(folder / "second.toml") << text;
  }
  /// Configuration of a machine with both recipes.
  std::string two_recipes(const std::string& first = kSmallRecipe,
                          const std::string& second = kSecondRecipe) const {
    write_second(second);
    const std::string file = write_config(small_machine(), kSmallRig, first);
    std::ofstream(file, std::ios::app) << kSecond;
    return file;
  }

  bool measures(Subprocess& daemon, std::int64_t recipe) const {
    return eventually(
        daemon, [&] { return read("system_recipe") == recipe && read("region_0_quality") != 0; });
  }
  /// Names of the complete pictures in a folder.
  std::vector<std::string> pictures(const std::string& name) const {
    std::vector<std::string> found;
    if (!std::filesystem::exists(folder / name)) return found;
    for (const auto& entry : std::filesystem::directory_iterator(folder / name)) {
      if (entry.path().extension() == ".png") found.push_back(entry.path().filename().string());
    }
    std::ranges::sort(found);
    return found;
  }
};

TEST_F(RecipeCommands, ARecipeIsSelectedAndTheViewsOfTheOtherStay) {
  Subprocess daemon = start(two_recipes());
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  EXPECT_EQ(read("view_count"), 3) << "one to look at, one of each recipe";
  EXPECT_EQ(command(daemon, CommandCode::SelectRecipe, {2}), CommandResult::Done);
  ASSERT_TRUE(measures(daemon, 2)) << daemon.output();
  EXPECT_NE(read("region_1_quality"), 0) << "it has a second region";
  EXPECT_EQ(command(daemon, CommandCode::SelectRecipe, {3}), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(command(daemon, CommandCode::PointView, {1, 0, 0, 0}), CommandResult::NotPossible);
  EXPECT_EQ(command(daemon, CommandCode::PointView, {0, 1000, 0, 0}), CommandResult::Done);
  EXPECT_EQ(read("system_recipe"), 2);
  EXPECT_EQ(command(daemon, CommandCode::SelectRecipe, {1}), CommandResult::Done);
  EXPECT_TRUE(measures(daemon, 1)) << daemon.output();
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

TEST_F(RecipeCommands, ACameraThatRefusesItsSettingsLeavesTheRecipe) {
  Subprocess daemon = start(two_recipes(with_control(kSmallRecipe, "TriggerMode", 0),
                                        with_control(kSecondRecipe, "TriggerMode", 7)));
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::SelectRecipe, {2}), CommandResult::Done);
  ASSERT_TRUE(says(daemon, "recipe 2: camera thermal: control \"TriggerMode\" cannot be set"))
      << daemon.output();
  EXPECT_TRUE(says(daemon, "; the previous recipe stays selected"));
  EXPECT_TRUE(measures(daemon, 1));
  EXPECT_TRUE(eventually(daemon, [&] {
    Subprocess state({ORBWATCH_PROGRAM, "state", "--json", "--domain", std::to_string(domain),
                      "--timeout", "60"},
                     folder.path() / "state.log");
    return state.wait() == 0 && state.output().find("\"recipe_refused\":true") != std::string::npos;
  })) << "the controller hears of it";
}

TEST_F(RecipeCommands, ARestartAfterARefusedRecipeKeepsTheOneThatIsMeasured) {
  const std::string config = two_recipes(with_control(kSmallRecipe, "TriggerMode", 0),
                                         with_control(kSecondRecipe, "TriggerMode", 0));
  std::ofstream(folder / "third.toml") << with_control(kSecondRecipe, "TriggerMode", 7);
  std::ofstream(config, std::ios::app) << "[[recipe]]\nnumber = 3\nfile = \"third.toml\"\n";
  Subprocess daemon = start(config);
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::SelectRecipe, {2}), CommandResult::Done);
  ASSERT_TRUE(measures(daemon, 2)) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::SelectRecipe, {3}), CommandResult::Done);
  constexpr std::int64_t kRefused = 1 << 13;
  ASSERT_TRUE(eventually(daemon, [&] {
    const auto bits = read("status_bits");
    return bits >= 0 && (bits & kRefused) != 0;
  })) << daemon.output();
  daemon.send(SIGHUP);
  ASSERT_TRUE(says(daemon, ", as before the restart")) << daemon.output();
  EXPECT_NE(daemon.output().find("recipe 2 is selected, as before the restart"), std::string::npos)
      << daemon.output();
  EXPECT_TRUE(measures(daemon, 2)) << daemon.output();
}

TEST_F(RecipeCommands, StoppedItKeepsTheRecipeAndMeasuresNothing) {
  Subprocess daemon = start(two_recipes());
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::Stop), CommandResult::Done);
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_state") == 4; })) << daemon.output();
  EXPECT_TRUE(eventually(daemon, [&] { return read("region_0_quality") == 0; }));
  const auto set = read("system_frame_set");
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > set; }))
      << "cameras go on";
  EXPECT_EQ(command(daemon, CommandCode::Start), CommandResult::Done);
  EXPECT_TRUE(measures(daemon, 1));
}

TEST_F(RecipeCommands, ACommandedTriggerIsOneResult) {
  Subprocess daemon = start(two_recipes());
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  EXPECT_EQ(read("system_result"), 0);
  for (std::int64_t n = 1; n <= 3; ++n) {
    ASSERT_EQ(command(daemon, CommandCode::Trigger), CommandResult::Done);
    ASSERT_TRUE(eventually(daemon, [&] { return read("system_result") == n; })) << daemon.output();
  }
  const auto set = read("system_frame_set");
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > set + 3; }));
  EXPECT_EQ(read("system_result"), 3);
  EXPECT_EQ(read("result_count"), 3);
  EXPECT_EQ(read("result_0_result"), 1) << "the oldest that nobody took";
  EXPECT_EQ(read("result_0_recipe"), 1);
  EXPECT_NE(read("result_0_quality"), 0);
}

TEST_F(RecipeCommands, ACameraThatOnlyCommandsTriggerExposesOncePerCommand) {
  std::string machine = small_machine();
  machine.insert(machine.find("frame_rate"),
                 "trigger_mode = \"software\"\ntrigger_source = \"software\"\n");
  Subprocess daemon = start(write_config(machine));
  ASSERT_TRUE(eventually(daemon, [&] { return read("camera_1_frames") > 0; })) << daemon.output();
  EXPECT_EQ(read("camera_0_frames"), 0) << "nobody asked for one";
  for (std::int64_t n = 1; n <= 4; ++n) {
    ASSERT_EQ(command(daemon, CommandCode::Trigger), CommandResult::Done);
    ASSERT_TRUE(eventually(daemon, [&] { return read("system_result") == n; })) << daemon.output();
    EXPECT_EQ(read("camera_0_frames"), n);
    EXPECT_EQ(read("system_trigger"), n);
  }
  EXPECT_EQ(read("camera_0_triggers"), 4);
  EXPECT_EQ(read("camera_0_missed"), 0);
}

TEST_F(RecipeCommands, SnapshotsAreWrittenWithTheirMeasuredPlane) {
  write_second(kSecondRecipe);
  const std::string file =
      write_config(small_machine() + "[snapshot]\nfolder = \"pictures\"\nkeep = 2\n");
  Subprocess daemon = start(file);
  ASSERT_TRUE(eventually(daemon, [&] {
    return read("region_0_hot_spot_peak_temperature") > 17000;
  })) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::Snapshot, {1}), CommandResult::Done);
  ASSERT_TRUE(eventually(daemon, [&] { return pictures("pictures").size() == 2; }))
      << daemon.output();
  const auto written = pictures("pictures");
  EXPECT_EQ(written[0].substr(0, 8), "process_");
  const cv::Mat colour = cv::imread((folder / "pictures" / written[0]).string());
  const cv::Mat measured =
      cv::imread((folder / "pictures" / written[1]).string(), cv::IMREAD_UNCHANGED);
  EXPECT_NE(written[1].find("_measured.png"), std::string::npos);
  EXPECT_EQ(colour.size(), cv::Size(160, 120));
  EXPECT_EQ(measured.size(), cv::Size(160, 120));
  EXPECT_EQ(measured.type(), CV_16U) << "counts as the camera gave them";
  double hottest = 0;
  cv::minMaxLoc(measured, nullptr, &hottest);
  EXPECT_GT(hottest * 0.04 - 273.15, 1400) << "a molten pool";
  EXPECT_EQ(command(daemon, CommandCode::Snapshot, {2}), CommandResult::ArgumentOutOfRange);
}

TEST_F(RecipeCommands, SnapshotsNeedAFolder) {
  Subprocess daemon = start(two_recipes());
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::Snapshot, {0}), CommandResult::NotPossible);
}

TEST_F(RecipeCommands, ARestartReadsTheFilesAgainUnlessTheyAreWrong) {
  Subprocess daemon = start(two_recipes());
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  const auto checksum = read("system_configuration_checksum");

  const std::string out_of_view = "directions = [[60, 40], [70, 40], [60, 50]]\n";
  std::string second = kSecondRecipe;
  write_second(second.insert(second.find("hot_spot_threshold"), out_of_view));
  EXPECT_EQ(command(daemon, CommandCode::Restart), CommandResult::NotPossible);
  ASSERT_TRUE(says(daemon, "does not restart: ")) << daemon.output();
  EXPECT_NE(daemon.output().find("second.toml: region all: "), std::string::npos)
      << "each file is right by itself: " << daemon.output();
  const auto set = read("system_frame_set");
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > set; })) << "it goes on";
  EXPECT_EQ(read("system_configuration_checksum"), checksum) << "with what it had";

  write_second("is no TOML");
  daemon.send(SIGHUP);
  ASSERT_TRUE(says(daemon, "second.toml:1: ")) << daemon.output();
  EXPECT_EQ(read("system_configuration_checksum"), checksum);

  write_second(kSecondRecipe + "# looked at again\n");
  write_command(port, static_cast<std::uint16_t>(CommandCode::Restart), {}, 999);
  ASSERT_TRUE(says(daemon, "restarts with its files read again")) << daemon.output();
  ASSERT_TRUE(eventually(daemon, [&] {
    const auto now = read("system_configuration_checksum");
    return now > 0 && now != checksum;
  })) << daemon.output();
  EXPECT_TRUE(measures(daemon, 1)) << "all begins anew";
  EXPECT_EQ(command(daemon, CommandCode::SelectRecipe, {2}), CommandResult::Done);
  EXPECT_TRUE(measures(daemon, 2));
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

TEST_F(RecipeCommands, AKilledDaemonRepeatsNoCommandOfTheStandingBlock) {
  const std::string config = two_recipes();
  {
    Subprocess daemon = start(config);
    ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
    EXPECT_EQ(command(daemon, CommandCode::Stop), CommandResult::Done);
    EXPECT_TRUE(eventually(
        daemon, [&] { return read("system_state") == std::int64_t(app::SystemState::Stopped); }));
    daemon.send(SIGKILL);
    daemon.wait();
  }
  Subprocess daemon = start(config);
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  EXPECT_EQ(read("acknowledged_sequence"), sequence) << "before the PLC writes";
  write_command(port, static_cast<std::uint16_t>(CommandCode::Stop), {}, sequence);
  // A later command in the queue shows that this one was processed.
  EXPECT_EQ(command(daemon, CommandCode::SelectRecipe, {2}), CommandResult::Done);
  EXPECT_TRUE(measures(daemon, 2)) << "it was stopped again";
}

TEST_F(RecipeCommands, ACommandedRestartIsOne) {
  Subprocess daemon = start(two_recipes());
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  EXPECT_EQ(command(daemon, CommandCode::Restart), CommandResult::Done);
  ASSERT_TRUE(says(daemon, "restarts with its files read again")) << daemon.output();
  const auto runs_again = [&] {
    const std::string said = daemon.output();
    return said.find("runs with") != said.rfind("runs with");
  };
  ASSERT_TRUE(eventually(daemon, runs_again)) << "until then the first one may still answer";
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  write_command(port, static_cast<std::uint16_t>(CommandCode::Restart), {}, sequence);
  EXPECT_EQ(command(daemon, CommandCode::SelectRecipe, {2}), CommandResult::Done);
  EXPECT_TRUE(measures(daemon, 2));
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
  const std::string said = daemon.output();
  EXPECT_EQ(said.find("restarts with"), said.rfind("restarts with")) << said;
}

TEST_F(RecipeCommands, WithoutAStateFolderItSaysSoAndTakesTheFirstAsKnown) {
  constexpr std::int64_t kNotRecorded = 1 << 7;
  state_folder = "/proc/orbwatch";
  Subprocess daemon = start(two_recipes());
  ASSERT_TRUE(measures(daemon, 1)) << daemon.output();
  EXPECT_NE(daemon.output().find("/proc/orbwatch: cannot be opened"), std::string::npos);
  EXPECT_TRUE(eventually(daemon, [&] { return (read("fault_bits") & kNotRecorded) != 0; }));
  EXPECT_EQ(read("health_commands_recorded"), 0);
  EXPECT_EQ(command(daemon, CommandCode::Stop), CommandResult::NotCarriedOut);
  EXPECT_EQ(command(daemon, CommandCode::SelectRecipe, {2}), CommandResult::Done);
  EXPECT_TRUE(measures(daemon, 2)) << "it was stopped";
}

TEST_F(RecipeCommands, ChecksWhatFollowsFromTheFilesToo) {
  std::string second = kSecondRecipe;
  const std::string file = two_recipes(kSmallRecipe, second.replace(second.find("900"), 3, "9000"));
  Subprocess check({ORBWATCHD_PROGRAM, "--check", "--config", file}, folder.path() / "said");
  EXPECT_EQ(check.wait(), 1);
  const std::string said = check.output();
  EXPECT_NE(said.find("second.toml: region all: "), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

}  // namespace
}  // namespace orbwatch::tests
