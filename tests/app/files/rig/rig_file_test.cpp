// SPDX-License-Identifier: Apache-2.0
#include "app/files/rig/rig_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/files/rig/camera_calibration.h"
#include "tests/app/files/refusal.h"
#include "tests/app/files/replaced.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::files {
namespace {

const std::string kValidRig = R"(
[ball]
centre = [120, 60, 430]
radius = 50
[scene]
room = "box"
low = [-600, -500, 0]
high = [600, 500, 800]
[[scene.obstacle]]
name = "table"
low = [-250, -200, 100]
high = [250, 200, 140]

[[camera]]
name = "A"
width = 1500
height = 1400
[camera.intrinsics]
fx = 7000
fy = 7010.5
cx = 749.5
cy = 701
distortion = "plumb_bob"
coefficients = [-0.1, 0.02, 0.001, -0.002]
[camera.pose]
position = [120, -540, 430]
rotation = [1, 0, 0,  0, 0, -1,  0, 1, 0]
[camera.window]
normal = [0, 1, 0]
thickness = 10

[[camera]]
name = "B"
width = 800
height = 600
model = "paper"
[camera.outline]
centre = [402.5, 297.25]
radii = [264, 263]
angle = 12
distance = 11.5
rotation = [90, 0, 0]
)";

Result<optics::Rig> parse(const std::string& text) {
  return parse_rig(text, "rig.toml", "/etc/orbwatch");
}

std::string rig_with(const std::string& what, const std::string& with,
                     const std::string& text = kValidRig) {
  return replaced(what, with, text);
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

TEST(RigFile, ReadsWhatIsThere) {
  const auto rig = parse(kValidRig);
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->ball.centre.z, 430);
  EXPECT_EQ(rig->ball.radius, 50);
  EXPECT_EQ(rig->scene.room, optics::Scene::Room::Box);
  EXPECT_EQ(rig->scene.walls.low.y, -500);
  EXPECT_EQ(rig->scene.walls.high.x, 600);
  ASSERT_EQ(rig->scene.obstacles.size(), 1u);
  EXPECT_EQ(rig->scene.obstacles[0].high.z, 140);
  ASSERT_EQ(rig->cameras.size(), 2u);

  const optics::RigCamera& a = rig->cameras[0];
  EXPECT_EQ(a.name, "A");
  EXPECT_EQ(a.model, optics::BallModel::Kind::Exact);
  EXPECT_EQ(a.intrinsics->width, 1500) << "the camera's";
  EXPECT_EQ(a.intrinsics->height, 1400);
  EXPECT_EQ(a.intrinsics->fy, 7010.5);
  EXPECT_EQ(a.intrinsics->cy, 701);
  EXPECT_EQ(a.intrinsics->distortion, optics::Distortion::Pinhole);
  EXPECT_EQ(a.intrinsics->coefficients[3], -0.002);
  EXPECT_EQ(a.pose->position.y, -540);
  EXPECT_EQ(a.pose->rotation.row2.y, 1);
  EXPECT_EQ(a.window->thickness, 10);
  EXPECT_EQ(a.window->index, 1.52);
  EXPECT_FALSE(a.outline);

  const optics::RigCamera& b = rig->cameras[1];
  EXPECT_EQ(b.model, optics::BallModel::Kind::Paper);
  EXPECT_EQ(b.outline->centre.v, 297.25);
  EXPECT_EQ(b.outline->ry, 263);
  EXPECT_EQ(b.outline->angle, 12);
  EXPECT_EQ(b.distance, 11.5);
  EXPECT_NEAR(b.registration.column1().x, 1, 1e-12) << "yaw 90 turns +Y to +X";
  EXPECT_FALSE(b.intrinsics || b.pose || b.window || b.alpha);
}

TEST(RigFile, EveryRoomHasItsKeys) {
  const std::string box = "room = \"box\"\nlow = [-600, -500, 0]\nhigh = [600, 500, 800]\n";
  const auto sphere =
      parse(rig_with(box, "room = \"sphere\"\ncentre = [0, 0, 400]\nradius = 700\n"));
  ASSERT_TRUE(sphere) << sphere.error().message;
  EXPECT_EQ(sphere->scene.room, optics::Scene::Room::Sphere);
  EXPECT_EQ(sphere->scene.radius, 700);
  const auto plane =
      parse(rig_with(box, "room = \"plane\"\npoint = [0, 0, 10]\nnormal = [0, 0, 3]\n"));
  ASSERT_TRUE(plane) << plane.error().message;
  EXPECT_EQ(plane->scene.point.z, 10);
  EXPECT_EQ(plane->scene.normal.z, 3);
  const auto open = parse(rig_with(box, ""));
  ASSERT_TRUE(open) << open.error().message;
  EXPECT_EQ(open->scene.room, optics::Scene::Room::None);
  EXPECT_EQ(open->scene.obstacles.size(), 1u);
}

TEST(RigFile, NeitherBallNorSceneNeedBeKnown) {
  const auto rig = parse(kValidRig.substr(kValidRig.rfind("[[camera]]")));
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->ball.radius, 1);
  EXPECT_EQ(rig->scene.room, optics::Scene::Room::None);
}

TEST(RigFile, ReadsACalibrationBesideIt) {
  const tests::TemporaryFolder folder;
  const optics::Intrinsics lens{1500, 1400, 7000, 7000, 750, 700, optics::Distortion::None, {}};
  const std::string begin = "[camera.intrinsics]\n", end = "[camera.pose]";
  const std::size_t from = kValidRig.find(begin) + begin.size();
  const std::string text =
      std::string(kValidRig).replace(from, kValidRig.find(end) - from, "file = \"lens.yaml\"\n");
  write(folder / "rig.toml", text);
  const auto missing = load_rig(folder / "rig.toml");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("lens.yaml: cannot be read"), std::string::npos)
      << missing.error().message;
  for (const auto format : {CalibrationFormat::OpenCv, CalibrationFormat::Ros}) {
    ASSERT_TRUE(write_calibration(folder / "lens.yaml", lens, "A", format));
    const auto rig = load_rig(folder / "rig.toml");
    ASSERT_TRUE(rig) << rig.error().message;
    EXPECT_EQ(rig->cameras[0].intrinsics->fx, 7000);
  }
  optics::Intrinsics other = lens;
  other.width = 1501;
  ASSERT_TRUE(write_calibration(folder / "lens.yaml", other, "A", CalibrationFormat::Ros));
  const auto refused = load_rig(folder / "rig.toml");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("1501x1400"), std::string::npos)
      << refused.error().message;
}

class RigFileRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(RigFileRefusal, SaysFileLineKeyAndReason) {
  const auto rig = parse(GetParam().text);
  ASSERT_FALSE(rig);
  expect_said(GetParam(), rig.error());
}

INSTANTIATE_TEST_SUITE_P(
    All, RigFileRefusal,
    testing::Values(
        Refusal{"NotToml", "[[camera\n", {"rig.toml:1:", "not valid TOML"}},
        Refusal{"UnknownKey",
                rig_with("radius = 50", "radius = 50\nradios = 3"),
                {"rig.toml:5: ball.radios", "centre, radius"}},
        Refusal{"NoCamera", "[ball]\ncentre=[0,0,0]\nradius=1\n", {"camera", "1 to 16"}},
        Refusal{"NoBall",
                rig_with("radius = 50", "radius = 0"),
                {"rig.toml:4: ball.radius", "above 0"}},
        Refusal{"BallWithoutCentre",
                rig_with("centre = [120, 60, 430]", ""),
                {"rig.toml:2: ball.centre", "missing"}},
        Refusal{"BallNowhere", rig_with("430]", "nan]"), {"rig.toml:3: ball.centre", "nan"}},
        Refusal{"PlaneNeedsPoint", rig_with("\"box\"", "\"plane\""), {"scene.point", "missing"}},
        Refusal{"BoxHasNoRadius",
                rig_with("room = \"box\"", "room = \"box\"\nradius = 3"),
                {"rig.toml:7: scene.radius", "only for room sphere"}},
        Refusal{"NoRoomHasNoWalls", rig_with("\"box\"", "\"none\""), {"scene.low", "room box"}},
        Refusal{"UnknownRoom", rig_with("\"box\"", "\"cave\""), {"rig.toml:6: scene.room", "cave"}},
        Refusal{"WallsCutTheBall",
                rig_with("high = [600", "high = [130"),
                {"rig.toml:5: scene: ", "cuts the ball"}},
        Refusal{"ObstacleCutsTheBall",
                rig_with("200, 140]", "200, 390]"),
                {"rig.toml:9: scene.obstacle: table", "cuts the ball"}},
        Refusal{"NoSize", rig_with("width = 1500\n", ""), {"rig.toml:14: camera.width", "missing"}},
        Refusal{
            "TwiceTheSameName", rig_with("\"B\"", "\"A\""), {"rig.toml:32: camera.name", "twice"}},
        Refusal{"BadName", rig_with("\"B\"", "\"B/1\""), {"rig.toml:32: camera.name", "B/1"}},
        Refusal{
            "NameOfTwoLines", rig_with("\"B\"", "\"B\\nC\""), {"rig.toml:32: camera.name", "B?C"}},
        Refusal{"NoFocalLength",
                rig_with("fx = 7000\n", ""),
                {"rig.toml:18: camera.intrinsics.fx", "missing"}},
        Refusal{"FileAndNumbers",
                rig_with("fx = 7000", "fx = 7000\nfile = \"a.yaml\""),
                {"rig.toml:19: camera.intrinsics.fx", "only for intrinsics without file"}},
        Refusal{"FileNamedByNothing",
                rig_with("fx = 7000", "file = \"\"\nfx = 7000"),
                {"rig.toml:19: camera.intrinsics.file: is empty"}},
        Refusal{"UnknownDistortion",
                rig_with("plumb_bob", "barrel"),
                {"rig.toml:23: camera.intrinsics.distortion", "barrel", "equidistant"}},
        Refusal{"TooFewCoefficients",
                rig_with("[-0.1, 0.02, ", "["),
                {"camera.intrinsics", "4 or 5", "2 are given"}},
        Refusal{"CoefficientsWithoutModel",
                rig_with("distortion = \"plumb_bob\"\n", ""),
                {"camera.intrinsics", "none takes no coefficients"}},
        Refusal{"NoRotation",
                rig_with("rotation = [1, 0, 0,", "rotation = [-1, 0, 0,"),
                {"rig.toml:27: camera.pose.rotation", "not a rotation"}},
        Refusal{"HalfARotation",
                rig_with("0, 0, -1,  0, 1, 0]", "0, 0, -1]"),
                {"rig.toml:27: camera.pose.rotation", "list of 9"}},
        Refusal{"LooksAway",
                rig_with("position = [120, -540,", "position = [120, 540,"),
                {"rig.toml:14: camera A: "}},
        Refusal{"PoseAndOutline",
                rig_with("[camera.window]",
                         "[camera.outline]\ncentre = [700, 700]\nradius = 500\n[camera.window]"),
                {"rig.toml:14: camera A: ", "either a pose or the ball's outline"}},
        Refusal{"NoPlace",
                rig_with("position = [120, -540, 430]\nrotation = [1, 0, 0,  0, 0, -1,  0, 1, 0]",
                         "", rig_with("[camera.pose]\n", "")),
                {"rig.toml:14: camera A: ", "either a pose or the ball's outline"}},
        Refusal{"NoGlass",
                rig_with("normal = [0, 1, 0]", "normal = [0, 0, 0]"),
                {"rig.toml:29: camera.window.normal", "not 0"}},
        Refusal{"WindowWithoutLens",
                kValidRig + "[camera.window]\nnormal = [0, 1, 0]\nthickness = 5\n",
                {"rig.toml:32: camera B: ", "window needs intrinsics"}},
        Refusal{"NeitherAlphaNorDistance",
                rig_with("distance = 11.5\n", ""),
                {"rig.toml:32: camera B: ", "alpha", "distance"}},
        Refusal{"AlphaAndDistance",
                rig_with("distance = 11.5", "distance = 11.5\nalpha = 340"),
                {"rig.toml:32: camera B: ", "either alpha or distance"}},
        Refusal{"AlphaOfNoCamera",
                rig_with("distance = 11.5", "alpha = 180"),
                {"rig.toml:41: camera.outline.alpha", "above 180, at most 360"}},
        Refusal{"RadiusAndRadii",
                rig_with("radii = [264, 263]", "radii = [264, 263]\nradius = 9"),
                {"rig.toml:40: camera.outline.radius", "either radius or radii"}},
        Refusal{"NeitherRadiusNorRadii",
                rig_with("radii = [264, 263]\n", ""),
                {"rig.toml:37: camera.outline.radius", "either radius or radii"}},
        Refusal{"NoRegistration",
                rig_with("rotation = [90, 0, 0]", "rotation_matrix = [1,0,0, 0,1,0, 0,0,-1]"),
                {"rig.toml:42: camera.outline.rotation_matrix", "not a rotation"}},
        Refusal{"DistanceWithinTheBall",
                rig_with("distance = 11.5", "distance = 0.9"),
                {"rig.toml:41: camera.outline.distance", "above 1"}},
        Refusal{"TwoRotations",
                kValidRig + "rotation_matrix = [1, 0, 0, 0, 1, 0, 0, 0, 1]\n",
                {"camera.outline.rotation_matrix", "either rotation or rotation_matrix"}},
        Refusal{"OutlineOutside",
                rig_with("[402.5,", "[802.5,"),
                {"rig.toml:32: camera B: ", "outside of the picture"}}),
    [](const auto& refusal) { return refusal.param.name; });

TEST(RigFile, MissingOrEndlessFileIsRefusedByName) {
  for (const char* file : {"/nonexistent/rig.toml", "/dev/zero"}) {
    const auto rig = load_rig(file);
    ASSERT_FALSE(rig);
    EXPECT_TRUE(rig.error().message.starts_with(std::string(file) + ": ")) << rig.error().message;
  }
}

TEST(RigFile, SurvivesEveryTruncation) {
  for (std::size_t length = 0; length < kValidRig.size(); ++length) {
    const auto rig = parse(kValidRig.substr(0, length));
    if (!rig) {
      EXPECT_EQ(rig.error().message.find('\n'), std::string::npos) << rig.error().message;
    }
  }
}

TEST(RigManual, IsWhatIsCommitted) {
  std::ifstream in(std::filesystem::path(ORBWATCH_SOURCE_DIR) / "app/files/RIG.md");
  std::stringstream committed;
  committed << in.rdbuf();
  EXPECT_EQ(committed.str(), rig_manual())
      << "regenerate it: orbwatch describe rig > app/files/RIG.md";
}

TEST(RigManual, ItsExampleIsValid) {
  const std::string text = rig_manual(), begin = "```toml\n";
  const std::size_t from = text.find(begin) + begin.size();
  const tests::TemporaryFolder folder;
  write(folder / "rig.toml", text.substr(from, text.find("```", from) - from));
  ASSERT_TRUE(write_calibration(
      folder / "a.yaml", {1500, 1500, 7000, 7000, 749.5, 749.5, optics::Distortion::None, {}}, "A",
      CalibrationFormat::Ros));
  const auto rig = load_rig(folder / "rig.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->cameras.size(), 2u);
}

}  // namespace
}  // namespace orbwatch::app::files
