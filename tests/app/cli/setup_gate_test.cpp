// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "app/files/rig/rig_file.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/daemon/daemon_program.h"
#include "tests/support/reference_data.h"
#include "tests/support/rendered_scene.h"

/// Runs `orbwatch setup` on recorded sequences of a rendered machine.
namespace orbwatch::tests {
namespace {

using optics::Vec3;

/// Numbers of scene.json, each after a comma.
std::string list(const cv::FileNode& numbers) {
  std::ostringstream text;
  text.precision(12);
  for (const cv::FileNode& row : numbers) {
    if (row.isSeq()) {
      text << list(row);
    } else {
      text << ',' << row.real();
    }
  }
  return text.str();
}

/// The projections of both cameras.
struct Projections {
  optics::BallProjection colour;
  optics::BallProjection thermal;
};

Projections truth(const cv::FileStorage& file, bool table_known = true) {
  const RenderedScene scene("near");
  optics::Rig rig =
      app::files::parse_rig(scene.rig(RenderedScene::Known::BoxAndTable), "rig.toml", "").value();
  if (!table_known) rig.scene.obstacles.clear();
  optics::RigCamera &colour = rig.cameras[0], &thermal = rig.cameras[2];
  const cv::FileNode seen = file["sequences"]["seq_spark"]["camera"];
  colour.width = colour.height = colour.intrinsics->width = colour.intrinsics->height =
      static_cast<int>(seen["width"]);
  colour.intrinsics->fx = colour.intrinsics->fy = seen["fx"].real();
  colour.intrinsics->cx = colour.intrinsics->cy = seen["cx"].real() - 0.5;
  return {optics::ball_projection(rig, colour).value(),
          optics::ball_projection(rig, thermal).value()};
}

/// Degrees rms between the directions found for both cameras and the true ones, over all directions
/// within 150 degrees of either camera.
double thermal_on_colour(const Projections& found, const Projections& truth) {
  constexpr int kSteps = 60;
  const double rim = std::cos(optics::radians(150));
  double squares = 0, count = 0;
  for (int row = 0; row < kSteps; ++row) {
    const double z = 2 * (row + 0.5) / kSteps - 1, across = std::sqrt(1 - z * z);
    for (int column = 0; column < 2 * kSteps; ++column) {
      const double angle = optics::radians(360.0 * column / (2 * kSteps));
      const Vec3 direction{across * std::cos(angle), across * std::sin(angle), z};
      if (dot(direction, truth.colour.facing()) < rim) continue;
      if (dot(direction, truth.thermal.facing()) < rim) continue;
      const auto a = truth.colour.pixel(direction), b = truth.thermal.pixel(direction);
      const auto by_colour = a ? found.colour.direction(*a) : std::nullopt;
      const auto by_thermal = b ? found.thermal.direction(*b) : std::nullopt;
      if (!by_colour || !by_thermal) continue;
      squares += std::pow(optics::degrees(norm(*by_colour - *by_thermal)), 2);
      ++count;
    }
  }
  return std::sqrt(squares / count);
}

class SetupGate : public CommandLine {
 protected:
  /// Calibration file in ROS' format.
  std::string calibration(const std::string& name, const cv::FileNode& camera) {
    std::ostringstream text;
    text.precision(12);
    text << "image_width: " << camera["width"].real()
         << "\nimage_height: " << camera["height"].real() << "\ncamera_name: " << name
         << "\ndistortion_model: plumb_bob\ncamera_matrix: {rows: 3, cols: 3, data: ["
         << camera["fx"].real() << ", 0, " << camera["cx"].real() - 0.5 << ", 0, "
         << camera["fy"].real() << ", " << camera["cy"].real() - 0.5
         << ", 0, 0, 1]}\ndistortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n";
    return write(name + ".yaml", text.str());
  }

  /// Runs setup with a known box of the machine, size of the ball, lenses and pose of the colour
  /// camera; the table in the box is optional.
  int set_up(const cv::FileStorage& file, bool table_known) {
    const auto pictures = [](const char* sequence) {
      return (rendered_pictures() / sequence).string();
    };
    const cv::FileNode colour = file["sequences"]["seq_spark"]["camera"];
    const cv::FileNode thermal = file["sequences"]["seq_thermal"]["camera"];
    const std::string box = list(file["box"]["lo"]) + list(file["box"]["hi"]);
    const std::string table = list(file["table"]["lo"]) + list(file["table"]["hi"]);
    std::vector<std::string> words{
        "setup",         "-o",
        path("site"),    "--ball-diameter",
        "100",           "--box=" + box.substr(1),
        "--camera",      "colour=" + pictures("seq_spark"),
        "--camera",      "thermal=" + pictures("seq_thermal"),
        "--calibration", "colour=" + calibration("colour", colour),
        "--calibration", "thermal=" + calibration("thermal", thermal),
        "--pose",        "colour=" + (list(colour["C"]) + list(colour["R_wc"])).substr(1)};
    if (table_known) words.insert(words.end(), {"--obstacle", "table=" + table.substr(1)});
    return run(words);
  }

  /// Degrees rms, thermal on colour.
  double error(const cv::FileStorage& file) {
    const auto rig = app::files::load_rig(path("site/rig.toml"));
    EXPECT_TRUE(rig && rig->cameras.size() == 2U) << said;
    if (!rig || rig->cameras.size() != 2U) return 180;
    const auto colour = optics::ball_projection(*rig, rig->cameras[0]);
    const auto thermal = optics::ball_projection(*rig, rig->cameras[1]);
    EXPECT_TRUE(colour && thermal);
    if (!colour || !thermal) return 180;
    const double error = thermal_on_colour({*colour, *thermal}, truth(file));
    std::printf("%sthermal on colour: %.2f deg rms\n", said.c_str(), error);
    RecordProperty("thermal on colour, deg rms", std::to_string(error));
    return error;
  }

  /// Checks that the daemon measures with the written files, at a free port.
  void expect_runs() {
    std::ifstream in(path("site/site.toml"));
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string usual = "port = 1502";
    const int port = free_port();
    ASSERT_NE(text.find(usual), std::string::npos) << text;
    text.replace(text.find(usual), usual.size(), "port = " + std::to_string(port));
    write("site/tried.toml", text);
    setenv("CYCLONEDDS_URI", loopback_dds().c_str(), 1);
    Subprocess daemon({ORBWATCHD_PROGRAM, "--config", path("site/tried.toml")},
                      folder.path() / "daemon.log");
    std::int64_t frame_set = 0;
    for (int n = 0; n < 600 && daemon.runs() && frame_set < 5; ++n) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));  // polls a real server
      frame_set = read_register(port, "system_frame_set");
    }
    EXPECT_GE(frame_set, 5) << daemon.output();
    daemon.send(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0) << daemon.output();
  }
};

TEST_F(SetupGate, ARenderedMachineIsSetUpFromItsSequences) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures());
  const cv::FileStorage file = open_rendered_scene();
  ASSERT_EQ(set_up(file, true), 0) << said;
  EXPECT_LE(error(file), 1.5) << said;
  EXPECT_EQ(said.find("a box of"), std::string::npos) << "finds what is stated already\n" << said;

  Subprocess check({ORBWATCHD_PROGRAM, "--config", path("site/site.toml"), "--check"},
                   folder.path() / "checked");
  EXPECT_EQ(check.wait(), 0) << check.output();
  expect_runs();
}

TEST_F(SetupGate, ItsTableNeedNotBeKnown) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures());
  const cv::FileStorage file = open_rendered_scene();
  ASSERT_EQ(set_up(file, false), 0) << said;
  // Error from the parallax of a table that is not stated, if everything else is right.
  const double by_table = thermal_on_colour(truth(file, false), truth(file));
  std::printf("without a table, all else right: %.2f deg rms\n", by_table);
  RecordProperty("without a table, all else right, deg rms", std::to_string(by_table));
  EXPECT_LE(error(file), 1) << said;

  EXPECT_NE(said.find("missing: whether there is a box of"), std::string::npos) << said;
  const auto rig = app::files::load_rig(path("site/rig.toml"));
  ASSERT_TRUE(rig) << rig.error().message;
  ASSERT_EQ(rig->scene.obstacles.size(), 1U);
  const auto top = file["table"]["hi"][2].real();
  EXPECT_NEAR(rig->scene.obstacles.front().high.z, top, 30);
}

}  // namespace
}  // namespace orbwatch::tests
