// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "app/files/rig/rig_file.h"
#include "proc/align/rotation_fit.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"
#include "tests/app/cli/recorded_pictures.h"
#include "tests/proc/align/register/camera_pair.h"
#include "tests/support/picture_of_mat.h"

/// Runs `orbwatch register` like a user.
namespace orbwatch::tests {
namespace {

using optics::Mat3;
using optics::Vec3;

std::string list(std::initializer_list<Vec3> vectors) {
  std::ostringstream text;
  text.precision(17);
  for (const Vec3& v : vectors) {
    text << (text.tellp() > 0 ? ", " : "[") << v.x << ", " << v.y << ", " << v.z;
  }
  return text.str() + "]";
}

std::string pose_of_seen(const MirrorRoomPicture& seen) {
  return "[camera.pose]\nposition = " + list({seen.position}) +
         "\nrotation = " + list({seen.axes.row0, seen.axes.row1, seen.axes.row2}) + "\n";
}

std::string outline_of_seen(const MirrorRoomPicture& seen) {
  const optics::Outline o = outline_of(seen);
  std::ostringstream text;
  text.precision(12);
  text << "[camera.outline]\ncentre = [" << o.centre.u << ", " << o.centre.v << "]\nradii = ["
       << o.rx << ", " << o.ry << "]\nangle = " << o.angle << "\n";
  return text.str();
}

std::string head(const std::string& name, const MirrorRoomPicture& seen) {
  const optics::Intrinsics lens = intrinsics_of(seen);
  std::ostringstream text;
  text.precision(12);
  text << "[[camera]]\nname = \"" << name << "\"\nwidth = " << lens.width
       << "\nheight = " << lens.height << "\n[camera.intrinsics]\nfx = " << lens.fx
       << "\nfy = " << lens.fy << "\ncx = " << lens.cx << "\ncy = " << lens.cy << "\n";
  return text.str();
}

class Register : public CommandLine {
 protected:
  /// Writes pictures of the cameras A and B of one room, and their rig.
  void write_room(bool pose_of_b) {
    pair_ = camera_pair(501, false);
    const MirrorRoomPicture &a = pair_.room.first, &b = pair_.room.second;
    const optics::Scene& scene = pair_.room.scene;
    write("a.png", a.pixels);
    write("b.png", b.pixels);
    std::string text =
        "# by hand\n[ball]\ncentre = [0, 0, 0]\nradius = 1\n[scene]\nroom = \"box\"\nlow = " +
        list({scene.walls.low}) + "\nhigh = " + list({scene.walls.high}) + "\n";
    int number = 0;
    for (const optics::Box& box : scene.obstacles) {
      text += "[[scene.obstacle]]\nname = \"box" + std::to_string(++number) +
              "\"\nlow = " + list({box.low}) + "\nhigh = " + list({box.high}) + "\n";
    }
    text += head("A", a) + pose_of_seen(a) + head("B", b);
    write("rig.toml", text + (pose_of_b ? pose_of_seen(turned(b)) : outline_of_seen(b)));
  }

  /// Simulates another position of the camera: turned about the ball, in the origin.
  static MirrorRoomPicture turned(MirrorRoomPicture seen) {
    const Mat3 turn = align::rotation_about({0.3, -0.2, 0.5});
    seen.axes = seen.axes * transposed(turn);
    seen.position = turn * seen.position;
    return seen;
  }

  std::vector<std::string> both() const {
    return {"register", "--rig", path("rig.toml"), "A=" + path("a.png"), "B=" + path("b.png")};
  }

  CameraPair pair_;
};

TEST_F(Register, SaysHowOneCameraStandsToTheOther) {
  write_room(false);
  auto arguments = both();
  arguments.insert(arguments.end(), {"--json", "-o", path("new.toml")});
  ASSERT_EQ(run(arguments), 0) << said;
  const auto json = nlohmann::json::parse(said.substr(said.find('{')));
  EXPECT_EQ(json["method"], "features");
  EXPECT_EQ(json["reference"], "A");
  EXPECT_EQ(json["camera"], "B");
  const auto m = json["rotation_matrix"].get<std::vector<double>>();
  ASSERT_EQ(m.size(), 9U);
  const Mat3 found{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
  EXPECT_LT(optics::degrees(align::angle_between(found, pair_.truth)), 0.2);
  const auto& angles = json["rotation"];
  EXPECT_LT(align::angle_between(optics::rotation({angles["yaw"], angles["pitch"], angles["roll"]}),
                                 found),
            1e-6);
  EXPECT_LT(json["residual_deg"], 2);
  EXPECT_GT(json["overlap"], 0.5);
  EXPECT_GT(json["inliers"], 15);
  EXPECT_EQ(json["sigma_deg"].size(), 3U);
  EXPECT_GT(json["direction_sigma_deg"], 0);
  EXPECT_LT(json["direction_sigma_deg"], 1);
  EXPECT_EQ(json["covariance"].size(), 9U);
  ASSERT_EQ(run({"register", "--help"}), 0);
  expect_documented(json, said);
  const auto rig = app::files::load_rig(path("new.toml"));
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_LT(align::angle_between(rig->cameras[1].registration, found), 1e-6);
}

TEST_F(Register, TakesPicturesOfCommonFrameSetsFromARecording) {
  write_room(false);
  auto arguments = both();
  arguments.emplace_back("--json");
  ASSERT_EQ(run(arguments), 0) << said;
  const std::string of_pictures = said;
  const cv::Mat a = cv::imread(path("a.png"), cv::IMREAD_UNCHANGED),
                b = cv::imread(path("b.png"), cv::IMREAD_UNCHANGED);
  const cv::Mat black = cv::Mat::zeros(a.size(), a.type());
  write_recorded_pictures(path("event.mcap"), {{"A", 1, picture_of_mat(black)},
                                               {"A", 2, picture_of_mat(a)},
                                               {"B", 2, picture_of_mat(b)},
                                               {"B", 3, picture_of_mat(black)}});
  const std::string event = path("event.mcap");
  ASSERT_EQ(run({"register", "--rig", path("rig.toml"), "A=" + event, "B=" + event, "--json"}), 0)
      << said;
  EXPECT_EQ(said, of_pictures);
  write_recorded_pictures(path("apart.mcap"),
                          {{"A", 1, picture_of_mat(a)}, {"B", 2, picture_of_mat(b)}});
  expect_refused("register", {"apart",
                              {"--rig", "DIR/rig.toml", "A=DIR/apart.mcap", "B=DIR/apart.mcap"},
                              {"A and B have no picture of the same frame set"}});
}

TEST_F(Register, ACameraWithAPoseIsTurnedAboutTheBall) {
  write_room(true);
  auto arguments = both();
  arguments.insert(arguments.end(), {"-o", path("rig.toml")});
  ASSERT_EQ(run(arguments), 0) << said;
  const auto rig = app::files::load_rig(path("rig.toml"));
  ASSERT_TRUE(rig) << rig.error().message;
  ASSERT_TRUE(rig->cameras[1].pose);
  const optics::Pose& pose = *rig->cameras[1].pose;
  const MirrorRoomPicture& truth = pair_.room.second;
  EXPECT_LT(optics::degrees(align::angle_between(pose.rotation, truth.axes)), 0.2);
  EXPECT_LT(norm(pose.position - truth.position), 0.005 * norm(truth.position));
}

TEST_F(Register, RefusesMistakesWithTheReason) {
  write_room(false);
  write("small.png", cv::Mat(100, 100, CV_8U, cv::Scalar(0)));
  std::filesystem::create_directory(path("empty"));
  const std::string rig = "DIR/rig.toml", a = "A=DIR/a.png", b = "B=DIR/b.png";
  for (const Mistake& mistake : {
           Mistake{"one camera", {"--rig", rig, a}, {"two cameras", "A=PATH B=PATH"}},
           Mistake{"no rig", {a, b}, {"--rig"}},
           Mistake{"a camera twice", {"--rig", rig, a, a}, {"A is given twice"}},
           Mistake{"no name", {"--rig", rig, a, "DIR/b.png"}, {"CAMERA=PATH"}},
           Mistake{"an unknown camera", {"--rig", rig, a, "Z=DIR/b.png"}, {"Z"}},
           Mistake{"no such file", {"--rig", rig, a, "B=DIR/none.png"}, {"none.png"}},
           Mistake{"an empty folder", {"--rig", rig, a, "B=DIR/empty"}, {"no pictures in it"}},
           Mistake{"another size",
                   {"--rig", rig, a, "B=DIR/small.png"},
                   {"the picture is 100x100 px, but camera B of the rig has 800x600 px"}},
           Mistake{"an unknown method", {"--rig", rig, a, b, "--method", "luck"}, {"luck", "auto"}},
       }) {
    SCOPED_TRACE(mistake.name);
    expect_refused("register", mistake);
  }
}

}  // namespace
}  // namespace orbwatch::tests
