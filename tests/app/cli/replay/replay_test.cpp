// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

#include "hal/thread/file_descriptor.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/daemon/replay/recorded_demo.h"

/// `orbwatch replay` of what the product's own pipeline measured of the demo.
namespace orbwatch::tests {
namespace {

using testing::HasSubstr;

constexpr std::size_t kSets = 60;

class Replay : public CommandLine {
 protected:
  static void SetUpTestSuite() { demo_ = new RecordedDemo(kSets); }
  static void TearDownTestSuite() {
    delete demo_;
    demo_ = nullptr;
  }

  std::string recording() {
    demo_->write(path("event.mcap"));
    return path("event.mcap");
  }
  /// The demo's recipe with a text replaced.
  std::string recipe_with(const std::string& before, const std::string& after) {
    std::string text = demo_->texts().files.at("demo-recipe.toml");
    const std::size_t at = text.find(before);
    EXPECT_NE(at, std::string::npos);
    return write("other.toml", text.replace(at, before.size(), after));
  }
  static std::string text_in(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  static RecordedDemo* demo_;
};
RecordedDemo* Replay::demo_ = nullptr;

TEST_F(Replay, MeasuresAsRecorded) {
  ASSERT_GT(demo_->pictures(), kSets / 2);
  EXPECT_EQ(run({"replay", recording(), "--compare"}), 0) << said;
  EXPECT_THAT(said, HasSubstr("0 of "));
  EXPECT_THAT(said,
              HasSubstr(" values in " + std::to_string(demo_->pictures()) + " frame sets differ"));
}

TEST_F(Replay, ComparesExactly) {
  // One count is 0.04 K.
  demo_->brighten(1);
  demo_->write(path("brighter.mcap"));
  demo_->brighten(-1);
  std::vector<std::string> arguments{"replay", path("brighter.mcap"), "--compare"};
  EXPECT_EQ(run(arguments), 1);
  EXPECT_THAT(said, HasSubstr(",hot_spot_peak_temperature,"));
  arguments.insert(arguments.end(), {"--tolerance", "0.01"});
  run(arguments);
  EXPECT_THAT(said, testing::Not(HasSubstr(",hot_spot_peak_temperature,")));
}

TEST_F(Replay, ListsWhatAnotherLimitChanges) {
  const std::string other = recipe_with("high_warning = 26", "high_warning = 12");
  EXPECT_EQ(run({"replay", recording(), "--compare", "--recipe", other}), 1);
  EXPECT_THAT(said, HasSubstr(",alarm,\"1, pool: hot_spot_width\",state,"));
  EXPECT_THAT(said, testing::Not(HasSubstr(",region,")));
}

TEST_F(Replay, ListsWhatAnotherRecipeMeasures) {
  const std::string other =
      recipe_with("hot_spot_threshold = 1400        # degC", "hot_spot_threshold = 1500");
  EXPECT_EQ(run({"replay", recording(), "--compare", "--recipe", "1=" + other}), 1);
  EXPECT_THAT(said, HasSubstr(",region,pool,hot_spot_width,"));
}

TEST_F(Replay, PrintsTheMeasurements) {
  ASSERT_EQ(run({"replay", recording(), "-o", path("measured.csv")}), 0) << said;
  std::ifstream csv(path("measured.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(csv, line));
  EXPECT_EQ(line, "utc_ns,frame_set,component,name,figure,value,unit");
  std::size_t widths = 0;
  while (std::getline(csv, line)) {
    widths += line.find(",region,pool,hot_spot_width,") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(widths, demo_->pictures());
}

TEST_F(Replay, AnErrorLeavesTheFilesThatAreThere) {
  const std::string file = recording(), before = text_in(file);
  expect_refused("replay",
                 {"itself", {"DIR/event.mcap", "-o", "DIR/event.mcap"}, {"the recording itself"}});
  EXPECT_TRUE(text_in(file) == before);
  const std::string measured = write("measured.csv", "of before\n");
  write("damaged.mcap", before.substr(0, 1000));
  expect_refused("replay",
                 {"damaged", {"DIR/damaged.mcap", "-o", "DIR/measured.csv"}, {"damaged.mcap"}});
  demo_->write(path("log.mcap"), false);
  expect_refused(
      "replay",
      {"log", {"DIR/log.mcap", "-o", "DIR/measured.csv"}, {"no frame set with pictures"}});
  EXPECT_EQ(text_in(measured), "of before\n");
  ASSERT_EQ(run({"replay", file, "-o", measured}), 0) << said;
  EXPECT_THAT(text_in(measured), testing::StartsWith("utc_ns,"));
}

TEST_F(Replay, APipeReceivesTheCsv) {
  const std::string fifo = path("fifo"), file = recording();
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  std::string piped;
  std::thread reader([&] { piped = text_in(fifo); });
  EXPECT_EQ(run({"replay", file, "-o", fifo}), 0) << said;
  // Ends a reader that waits for a program that did not open the pipe.
  static_cast<void>(hal::FileDescriptor(::open(fifo.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC)));
  reader.join();
  ASSERT_EQ(run({"replay", file, "-o", path("measured.csv")}), 0) << said;
  EXPECT_THAT(piped, testing::StartsWith("utc_ns,"));
  EXPECT_TRUE(piped == text_in(path("measured.csv")));
}

TEST_F(Replay, ALinkStaysAndItsFileIsReplaced) {
  const std::string measured = write("measured.csv", "of before\n"), linked = path("link.csv");
  std::filesystem::create_symlink(measured, linked);
  ASSERT_EQ(run({"replay", recording(), "-o", linked}), 0) << said;
  EXPECT_TRUE(std::filesystem::is_symlink(linked));
  EXPECT_THAT(text_in(measured), testing::StartsWith("utc_ns,"));
}

TEST_F(Replay, CtrlCLeavesNoPartOfAFile) {
  const auto has_part = [this] {
    return std::ranges::any_of(std::filesystem::directory_iterator(folder.path()),
                               [](const auto& file) { return file.path().extension() == ".part"; });
  };
  Subprocess program({ORBWATCH_PROGRAM, "replay", recording(), "-o", path("measured.csv")},
                     folder / "said");
  while (program.runs() && !has_part()) std::this_thread::yield();
  program.send(SIGINT);
  const int code = program.wait();
  EXPECT_EQ(std::filesystem::exists(path("measured.csv")), code == 0) << program.output();
  EXPECT_FALSE(has_part());
}

TEST_F(Replay, NeedsPicturesAndTheConfigurationInTheFile) {
  demo_->write(path("log.mcap"), false);
  expect_refused("replay", {"pictures", {"DIR/log.mcap"}, {"no frame set with pictures"}});
  auto& files = demo_->texts().files;
  const auto rig = files.extract("demo-rig.toml");
  demo_->write(path("rigless.mcap"));
  expect_refused("replay", {"rig", {"DIR/rigless.mcap"}, {"rigless.mcap/demo-rig.toml"}});
  files.insert(files.begin(), {rig.key(), rig.mapped()});
  expect_refused("replay", {"file", {"DIR/missing.mcap"}, {"missing.mcap"}});
  recording();
  const std::string second = "2=" + write("second.toml", files.at("demo-recipe.toml"));
  expect_refused("replay", {"recipe", {"DIR/event.mcap", "--recipe", second}, {"recipe 2"}});
  expect_refused("replay", {"words", {}, {"name one recording"}});
  expect_refused("replay", {"share", {"DIR/event.mcap", "--tolerance", "1"}, {"--tolerance"}});
}

/// The demo measured by its colour camera.
app::files::Resolved measured_in_colour() {
  const std::string recipe =
      "name = \"light\"\n[[view]]\nname = \"process\"\nmeasured = \"colour\"\nyaw = -115\n"
      "pitch = -40\nh_fov = 80\nwidth = 640\nheight = 480\n"
      "[[view.source]]\ncamera = \"colour\"\n[[region]]\nname = \"pool\"\nview = \"process\"\n"
      "points = [[-190, -130, 178], [-30, -130, 178], [-30, 30, 178], [-190, 30, 178]]\n"
      "hot_spot_threshold = 80\n[[region.alarm]]\nsignal = \"hot_spot_width\"\n"
      "high_warning = 1000\n";
  auto site = app::files::resolve(app::daemon::kShippedFolder / "demo.toml",
                                  {{app::daemon::kShippedFolder / "demo-recipe.toml", recipe}});
  EXPECT_TRUE(site) << site.error().message;
  return site.value_or(app::files::Resolved{});
}

/// Numbers of listed differences of regions that JPEG explains, and of the others.
std::pair<std::size_t, std::size_t> differences_in(const std::string& said) {
  std::istringstream lines(said);
  std::size_t explained = 0, others = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find(",region,") == std::string::npos) continue;
    ++(line.ends_with(",jpeg") ? explained : others);
  }
  return {explained, others};
}

TEST_F(Replay, JpegExplainsItsDifferencesAndLosslessColourHasNone) {
  const RecordedDemo colour(40, measured_in_colour(), 0);
  colour.write(path("lossless.mcap"));
  ASSERT_EQ(run({"replay", path("lossless.mcap"), "--compare"}), 0) << said;
  EXPECT_THAT(said, HasSubstr("0 of "));
  EXPECT_THAT(said, testing::Not(HasSubstr("JPEG")));
  colour.write(path("jpeg.mcap"), true, 90);
  run({"replay", path("jpeg.mcap"), "--compare"});
  EXPECT_THAT(said, HasSubstr(" differ no more than JPEG explains"));
  // A spark that touches the pool may be joined to it by a pixel: no tolerance explains that.
  const auto [explained, others] = differences_in(said);
  EXPECT_GT(explained, 200U);
  EXPECT_LT(others, explained / 5) << said;
  colour.write(path("poor.mcap"), true, 40);
  EXPECT_EQ(run({"replay", path("poor.mcap"), "--compare"}), 1) << said;
  EXPECT_THAT(said, testing::Not(HasSubstr("JPEG")));
}

}  // namespace
}  // namespace orbwatch::tests
