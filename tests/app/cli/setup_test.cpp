// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>

#include "app/files/resolve.h"
#include "app/files/rig/rig_file.h"
#include "hal/host.h"
#include "proc/align/rotation_fit.h"
#include "proc/optics/rotation.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"
#include "tests/proc/align/detect/painted_ball.h"

/// Runs `orbwatch setup` like an installer, on recorded pictures.
namespace orbwatch::tests {
namespace {

using align::kPaintedLimb;

const char* const kCalibration =
    "image_width: 400\nimage_height: 320\ncamera_name: a\ndistortion_model: plumb_bob\n"
    "camera_matrix: {rows: 3, cols: 3, data: [900, 0, 199.5, 0, 900, 159.5, 0, 0, 1]}\n"
    "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n";

class Setup : public CommandLine {
 protected:
  std::string picture() {
    return write("ball.png", align::painted_ball(align::kPaintedSize, kPaintedLimb));
  }

  int set_up(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"setup", "-o", path("site"), "--ball-diameter", "80"});
    return run(arguments);
  }

  optics::Rig rig() {
    const auto rig = app::files::load_rig(path("site/rig.toml"));
    EXPECT_TRUE(rig) << rig.error().message;
    return rig.value_or(optics::Rig{});
  }

  /// Lets the daemon check the site, which must succeed with these words.
  void expect_runs(const std::string& words = "") {
    Subprocess daemon({ORBWATCHD_PROGRAM, "--config", path("site/site.toml"), "--check"},
                      folder.path() / "checked");
    EXPECT_EQ(daemon.wait(), 0) << daemon.output();
    EXPECT_NE(daemon.output().find(words), std::string::npos) << daemon.output();
  }
};

TEST_F(Setup, WritesASiteThatTheDaemonAccepts) {
  ASSERT_EQ(set_up({"--camera", picture()}), 0) << said;
  expect_runs();
  const optics::Rig rig = this->rig();
  ASSERT_EQ(rig.cameras.size(), 1U);
  EXPECT_EQ(rig.cameras[0].name, "grey");
  EXPECT_NEAR(rig.cameras[0].outline->rx, kPaintedLimb.rx, 1.2);
  EXPECT_EQ(rig.ball.radius, 40);
  EXPECT_TRUE(std::filesystem::exists(path("site/grey.png")));
}

TEST_F(Setup, ServesThePageToThisComputerUnlessItIsTold) {
  const auto page_of = [&](const std::vector<std::string>& option) {
    std::vector<std::string> arguments{"--camera", picture(), "--force"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    EXPECT_EQ(set_up(arguments), 0) << said;
    const auto site = app::files::resolve(path("site/site.toml"));
    EXPECT_TRUE(site) << site.error().message;
    return site ? std::get<app::WebSettings>(site->site.sinks) : app::WebSettings{};
  };
  for (const std::vector<std::string>& option :
       std::vector<std::vector<std::string>>{{}, {"--page", "loopback"}}) {
    const app::WebSettings here = page_of(option);
    EXPECT_TRUE(here.enabled);
    EXPECT_EQ(http_addresses_of(here), std::vector<std::string>{"127.0.0.1"});
    EXPECT_EQ(https_port_of(here), std::nullopt) << "no other computer";
  }
  const app::WebSettings everywhere = page_of({"--page", "network"});
  EXPECT_TRUE(everywhere.enabled);
  EXPECT_EQ(everywhere.address, "0.0.0.0");
  EXPECT_EQ(https_port_of(everywhere), 8443);
  EXPECT_EQ(everywhere.names, std::vector<std::string>{hal::host_name()});
  EXPECT_FALSE(page_of({"--page", "none"}).enabled);
}

TEST_F(Setup, SaysWhatIsMissingAndWhatAddsIt) {
  ASSERT_EQ(set_up({"--camera", "colour=" + picture()}), 0) << said;
  EXPECT_NE(said.find("--distance colour=MM"), std::string::npos) << said;
  EXPECT_NE(said.find("orbwatch place --rig " + path("site/rig.toml") + " --camera colour"),
            std::string::npos)
      << said;
}

TEST_F(Setup, NamesTheTrialOfAnInstalledServiceElseTheDaemon) {
  const std::string site = path("site/site.toml");
  const std::string run_daemon = "written and checked: run orbwatchd --config " + site + "\n";
  const std::map<std::string, std::string> expected{
      {path("missing.toml"), run_daemon},
      {site, run_daemon},
      {write("installed.toml", std::string()),
       "written and checked; try it: sudo orbwatch configure " + site + "\n"}};
  for (const auto& [installed, next] : expected) {
    ::setenv("ORBWATCH_CONFIG", installed.c_str(), 1);
    EXPECT_EQ(set_up({"--camera", picture(), "--force"}), 0) << said;
    EXPECT_NE(said.find(next), std::string::npos) << installed << ": " << said;
  }
  ::unsetenv("ORBWATCH_CONFIG");
}

TEST_F(Setup, TellsProgramsTheSame) {
  ASSERT_EQ(set_up({"--camera", "colour=" + picture(), "--json"}), 0) << said;
  const auto json = parsed(said);
  EXPECT_EQ(json["site"], path("site/site.toml"));
  ASSERT_EQ(json["cameras"].size(), 1U);
  EXPECT_EQ(json["cameras"][0]["name"], "colour");
  EXPECT_NEAR(json["cameras"][0]["outline"]["radii"][0].get<double>(), kPaintedLimb.rx, 1.2);
  EXPECT_GE(json["cameras"][0]["confidence"].get<double>(), 0.5);
  EXPECT_EQ(json["cameras"][0]["registered"], false);
  EXPECT_NE(json["missing"].dump().find("--distance colour=MM"), std::string::npos) << said;
  ASSERT_EQ(run({"setup", "--help"}), 0);
  expect_documented(json, said);
}

TEST_F(Setup, WithAPoseItKnowsWhereTheBallIs) {
  write("a.yaml", kCalibration);
  ASSERT_EQ(set_up({"--camera", picture(), "--calibration", path("a.yaml"), "--pose",
                    "10,-300,400,1,0,0,0,0,-1,0,1,0", "--box=-600,-500,0,600,500,800"}),
            0)
      << said;
  expect_runs();
  EXPECT_EQ(said.find("missing: where"), std::string::npos) << said;
  // Radius 115 px at 900 px focal length: 7.9 ball radii away, 2.4 mm off the axis per px.
  const optics::Rig rig = this->rig();
  EXPECT_NEAR(rig.ball.centre.y, -300 + 7.9 * 40, 4);
  EXPECT_NEAR(rig.ball.centre.x, 10 + 316.0 * (202.3 - 199.5) / 900, 0.6);
  EXPECT_NEAR(rig.ball.centre.z, 400 - 316.0 * (161.7 - 159.5) / 900, 0.6);
  EXPECT_TRUE(rig.cameras[0].pose);
}

/// A camera that is turned in all its axes, with so many decimals.
std::string pose_text(int decimals) {
  const optics::Mat3 matrix =
      optics::rotation({30, 20, 10}) * optics::Mat3{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  std::string text = "10,-300,400";
  for (const optics::Vec3& row : {matrix.row0, matrix.row1, matrix.row2}) {
    for (const double value : {row.x, row.y, row.z}) {
      char number[32];
      std::snprintf(number, sizeof number, ",%.*f", decimals, value);
      text += number;
    }
  }
  return text;
}

TEST_F(Setup, RoundedPosesBecomeRotationsAndSayByHowMuch) {
  write("a.yaml", kCalibration);
  const std::vector<std::string> camera{"--camera",     picture(), "--calibration",
                                        path("a.yaml"), "--force", "--pose"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), camera.begin(), camera.end());
    return more;
  };
  ASSERT_EQ(set_up(with({pose_text(12)})), 0) << said;
  EXPECT_EQ(said.find("rounded"), std::string::npos) << said;
  const optics::Mat3 exact = rig().cameras[0].pose->rotation;
  ASSERT_EQ(set_up(with({pose_text(4)})), 0) << said;
  EXPECT_NE(said.find("grey: the matrix of --pose is rounded; its axes were turned by up to 0.00"),
            std::string::npos)
      << said;
  expect_runs();
  EXPECT_LT(optics::degrees(align::angle_between(rig().cameras[0].pose->rotation, exact)), 0.01);
  ASSERT_EQ(set_up(with({pose_text(4), "--json"})), 0) << said;
  const double change = parsed(said)["cameras"][0]["pose_change"].get<double>();
  EXPECT_GT(change, 1e-4);
  EXPECT_LT(change, 0.009);
}

/// The two pictures have only the ball in common.
TEST_F(Setup, LeavesOutWhatItCouldNotRegister) {
  const std::string first = picture();
  cv::Mat other = align::painted_ball(align::kPaintedSize, kPaintedLimb);
  cv::flip(other, other, 1);  // no rotation of a camera makes a mirror image
  other.convertTo(other, CV_16U, 20);
  const std::string thermal = write("thermal.png", other);
  EXPECT_EQ(set_up({"--camera", "grey=" + first, "--camera", "thermal=" + thermal}), 1) << said;
  EXPECT_NE(said.find("not registered: left out of merged and measured views"), std::string::npos)
      << said;
  EXPECT_NE(said.find("orbwatch: left out of merged and measured views: thermal\n"),
            std::string::npos)
      << said;
  expect_runs("camera thermal: is not registered, and left out of merged and measured views");
  const optics::Rig rig = this->rig();
  ASSERT_EQ(rig.cameras.size(), 2U);
  EXPECT_TRUE(rig.cameras[0].is_registered);
  EXPECT_FALSE(rig.cameras[1].is_registered);
  std::stringstream recipe;
  recipe << std::ifstream(path("site/recipe.toml")).rdbuf();
  EXPECT_NE(recipe.str().find("measured = \"grey\""), std::string::npos) << recipe.str();
  EXPECT_EQ(run({"project", "-o", path("view.png"), "--rig", path("site/rig.toml"), "--camera",
                 "grey=" + first, "--camera", "thermal=" + first}),
            1);
  EXPECT_NE(said.find("camera thermal is not registered"), std::string::npos) << said;
}

TEST_F(Setup, FailsAfterItHasLeftOutACameraWithoutABall) {
  const std::string empty = write("empty.png", cv::Mat(320, 400, CV_8UC1, cv::Scalar(90)));
  EXPECT_EQ(set_up({"--camera", "grey=" + picture(), "--camera", "other=" + empty, "--json"}), 1);
  EXPECT_NE(said.find("left out of merged and measured views: other\n"), std::string::npos) << said;
  const auto json = parsed(said.substr(0, said.rfind("orbwatch: ")));
  EXPECT_EQ(json["left_out"].dump(), "[\"other\"]");
  EXPECT_EQ(json["cameras"].size(), 1U);
  expect_runs();
}

TEST_F(Setup, OverwritesOnlyWhenItIsTold) {
  ASSERT_EQ(set_up({"--camera", picture()}), 0) << said;
  write("site/rig.toml", std::string("by hand"));
  EXPECT_EQ(set_up({"--camera", picture()}), 1);
  EXPECT_NE(said.find("--force"), std::string::npos) << said;
  std::stringstream text;
  text << std::ifstream(path("site/rig.toml")).rdbuf();
  EXPECT_EQ(text.str(), "by hand");
  EXPECT_EQ(set_up({"--camera", picture(), "--force"}), 0) << said;
  expect_runs();
}

TEST_F(Setup, RefusesMistakesInOneLine) {
  write("a.yaml", kCalibration);
  picture();
  const std::vector<std::string> camera{"-o", "DIR/site", "--camera", "DIR/ball.png",
                                        "--ball-diameter"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), camera.begin(), camera.end());
    return more;
  };
  for (const Mistake& mistake : std::vector<Mistake>{
           {"no folder", {"--ball-diameter", "80"}, {"-o DIR"}},
           {"no diameter", with({"0"}), {"--ball-diameter"}},
           {"no such camera", with({"80", "--distance", "thermal=300"}), {"thermal", "grey"}},
           {"box in no axes", with({"80", "--box=0,0,0,1,1,1"}), {"--pose"}},
           {"short pose", with({"80", "--pose", "1,2,3"}), {"3 numbers", "12"}},
           {"a matrix of two decimals",
            with({"80", "--pose", pose_text(2), "--calibration", "DIR/a.yaml"}),
            {"not a rotation", "four decimals"}},
           {"no lens", with({"80", "--pose", "1,2,3,1,0,0,0,0,-1,0,1,0"}), {"--calibration"}},
           {"distance within the ball",
            with({"80", "--distance", "39"}),
            {"--distance grey=39", "in the ball, whose radius is 40 mm"}},
           {"no such page", with({"80", "--page", "lan"}), {"--page", "loopback"}},
           {"negative distance", with({"80", "--distance=-4"}), {"distance", "above"}},
           {"contradiction",
            with({"80", "--pose", "10,-300,400,1,0,0,0,0,-1,0,1,0", "--calibration", "DIR/a.yaml",
                  "--ball-centre", "10,500,400"}),
            {"ball-centre", "wrong"}}}) {
    SCOPED_TRACE(mistake.name);
    expect_refused("setup", mistake);
  }
}

}  // namespace
}  // namespace orbwatch::tests
