// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/files/rig/rig_file.h"
#include "proc/optics/view_projection.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"
#include "tests/proc/align/place/mirrored_rig.h"
#include "tests/proc/align/place/mirrored_tags.h"

/// Runs `orbwatch place` like a user, on a machine that is simulated by plain vectors.
namespace orbwatch::tests {
namespace {

class Place : public CommandLine {
 protected:
  Place() {
    std::mt19937_64 random(7);
    machine = random_rig(random, {2, 8, 300, 600});
    write("rig.toml", rig_text());
  }

  std::string rig_text(bool has_outlines = true) const {
    std::ostringstream out;
    out.precision(12);
    const optics::Vec3& c = machine.centre;
    out << "# Hand-written.\n[ball]\ncentre = [" << c.x << ", " << c.y << ", " << c.z
        << "]\nradius = " << machine.radius << "  # with a calliper\n";
    for (std::size_t n = 0; n < machine.cameras.size(); ++n) {
      const RigCamera& camera = machine.cameras[n];
      const SeenLimb limb = limb_of(camera, machine.centre, machine.radius);
      out << "\n[[camera]]\nname = \"" << name(n) << "\"\nwidth = " << camera.width
          << "\nheight = " << camera.height << "\n[camera.intrinsics]\nfx = " << camera.focal
          << "\nfy = " << camera.focal << "\ncx = " << camera.middle().u
          << "\ncy = " << camera.middle().v << "\n";
      if (!has_outlines) continue;
      out << "[camera.outline]\ncentre = [" << limb.centre.u << ", " << limb.centre.v
          << "]\nradii = [" << limb.rx << ", " << limb.ry << "]\nangle = " << limb.angle << "\n";
    }
    return out.str();
  }

  static std::string name(std::size_t camera) { return camera == 0 ? "A" : "B"; }

  std::string point(std::size_t camera, std::size_t n, double slip = 0) const {
    const optics::Vec3& p = machine.points[n];
    const optics::Vec2 pixel = seen_at(machine.cameras[camera], machine.centre, machine.radius, p);
    char text[200];
    std::snprintf(text, sizeof text, "%.6f,%.6f=%.9f,%.9f,%.9f", pixel.u + slip, pixel.v, p.x, p.y,
                  p.z);
    return text;
  }

  std::vector<std::string> marked(std::size_t camera, double slip_of_third = 0) const {
    std::vector<std::string> words{"--camera", name(camera)};
    for (std::size_t n = 0; n < machine.points.size(); ++n) {
      words.insert(words.end(), {"--point", point(camera, n, n == 2 ? slip_of_third : 0)});
    }
    return words;
  }

  /// Runs it for both cameras.
  int place(const std::vector<std::string>& options, double slip_of_third = 0) {
    std::vector<std::string> words{"place", "--rig", path("rig.toml")};
    for (const auto& part : {marked(0, slip_of_third), marked(1), options}) {
      words.insert(words.end(), part.begin(), part.end());
    }
    return run(words);
  }

  MirroredRig machine;
};

TEST_F(Place, PlacesCamerasTogether) {
  ASSERT_EQ(place({"--json", "--ball-centre", "unknown", "--sigma-mm", "0"}), 0) << said;
  const auto json = nlohmann::json::parse(said);
  EXPECT_NEAR(json["ball_centre"][0].get<double>(), machine.centre.x, 1e-2);
  EXPECT_GT(json["ball_centre_sigma"].get<double>(), 0);
  ASSERT_EQ(json["cameras"].size(), 2U);
  for (std::size_t c = 0; c < 2; ++c) {
    const auto& camera = json["cameras"][c];
    const optics::Pose& truth = machine.cameras[c].pose;
    EXPECT_EQ(camera["name"], name(c));
    EXPECT_NEAR(camera["position"][0].get<double>(), truth.position.x, 0.05);
    EXPECT_NEAR(camera["position"][2].get<double>(), truth.position.z, 0.05);
    EXPECT_NEAR(camera["rotation"][1].get<double>(), truth.rotation.row0.y, 1e-4);
    EXPECT_NEAR(camera["rotation"][8].get<double>(), truth.rotation.row2.z, 1e-4);
    EXPECT_GT(camera["direction_sigma"].get<double>(), 0.01);
    EXPECT_LT(camera["direction_sigma"].get<double>(), 2);
    EXPECT_EQ(camera["covariance"].size(), 6U);
    ASSERT_EQ(camera["points"].size(), 8U);
    EXPECT_LT(std::abs(camera["points"][0]["residual"][0].get<double>()), 0.01);
    EXPECT_EQ(camera["points"][0]["outlier"], false);
  }
  ASSERT_EQ(run({"place", "--help"}), 0);
  expect_documented(json, said);
}

TEST_F(Place, WritesTheRigAndKeepsWhatAPersonWrote) {
  ASSERT_EQ(place({"-o", path("placed.toml")}), 0) << said;
  const auto rig = app::files::load_rig(path("placed.toml"));
  ASSERT_TRUE(rig) << rig.error().message;
  for (std::size_t c = 0; c < 2; ++c) {
    ASSERT_TRUE(rig->cameras[c].pose);
    const optics::Vec3 off = rig->cameras[c].pose->position - machine.cameras[c].pose.position;
    EXPECT_LT(norm(off), 0.05);
    EXPECT_FALSE(rig->cameras[c].outline);
    // The direction by the written rig must match the reflection.
    const auto ball = optics::ball_projection(*rig, rig->cameras[c]);
    ASSERT_TRUE(ball);
    const optics::Vec3 way = machine.points[0] - machine.centre;
    const auto shown = ball->pixel(normalized(way), machine.radius / norm(way));
    const auto truth =
        seen_at(machine.cameras[c], machine.centre, machine.radius, machine.points[0]);
    ASSERT_TRUE(shown);
    EXPECT_NEAR(shown->u, truth.u, 0.02);
    EXPECT_NEAR(shown->v, truth.v, 0.02);
  }
  std::ifstream file(path("placed.toml"));
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(text.find("# with a calliper"), std::string::npos);
}

/// Point in a view of that size, all around, by the product's own projections: their correctness is
/// tested elsewhere; here they only convert there and back.
optics::Vec2 seen_in_view(const optics::BallProjection& ball, const optics::Vec2& pixel) {
  optics::ViewSpec spec{optics::ViewKind::Equirectangular, {}, {}, {}, 1000, 500};
  return *optics::ViewProjection::make(spec)->pixel(*ball.direction(pixel));
}

TEST_F(Place, TakesPointsMarkedInAView) {
  const auto rig = app::files::load_rig(path("rig.toml"));
  ASSERT_TRUE(rig) << rig.error().message;
  const auto ball = optics::ball_projection(*rig, rig->cameras[0]);
  ASSERT_TRUE(ball) << ball.error().message;
  std::vector<std::string> words{
      "place",           "--rig",  path("rig.toml"), "--json",   "--view",
      "equirectangular", "--size", "1000x500",       "--camera", "A"};
  for (const optics::Vec3& p : machine.points) {
    const auto pixel =
        seen_in_view(*ball, seen_at(machine.cameras[0], machine.centre, machine.radius, p));
    char text[200];
    std::snprintf(text, sizeof text, "%.6f,%.6f=%.9f,%.9f,%.9f", pixel.u, pixel.v, p.x, p.y, p.z);
    words.insert(words.end(), {"--view-point", text});
  }
  ASSERT_EQ(run(words), 0) << said;
  const auto camera = nlohmann::json::parse(said)["cameras"][0];
  const optics::Pose& truth = machine.cameras[0].pose;
  EXPECT_NEAR(camera["position"][0].get<double>(), truth.position.x, 0.05);
  EXPECT_NEAR(camera["rotation"][1].get<double>(), truth.rotation.row0.y, 1e-4);
  EXPECT_LT(std::abs(camera["points"][0]["residual"][0].get<double>()), 0.01);
  words.insert(words.end(), {"--view-point", "1000,20=1,2,3"});
  EXPECT_NE(run(words), 0);
  EXPECT_NE(said.find("1000x500 pixels shows nothing of it at (1000, 20)"), std::string::npos)
      << said;
}

TEST_F(Place, FindsTheFocalLength) {
  ASSERT_EQ(place({"--json", "--sigma-px", "0.2", "--outline-sigma", "0.2", "--sigma-mm", "0"}), 0)
      << said;
  std::vector<std::string> words{"place",      "--rig", path("rig.toml"),  "--json",
                                 "--sigma-px", "0.1",   "--outline-sigma", "0.1",
                                 "--sigma-mm", "0"};
  const auto points = marked(0);
  words.insert(words.end(), points.begin(), points.end());
  words.insert(words.end(), {"--focal", "unknown"});
  ASSERT_EQ(run(words), 0) << said;
  const auto camera = nlohmann::json::parse(said)["cameras"][0];
  EXPECT_NEAR(camera["focal_length"][0].get<double>() / machine.cameras[0].focal, 1, 1e-3);
  EXPECT_GT(camera["focal_sigma"].get<double>(), 0);
}

TEST_F(Place, NamesAMisclickedPointAndWritesNothing) {
  ASSERT_EQ(place({}, 40), 0) << said;
  const std::size_t at = said.find("WRONG");
  ASSERT_NE(at, std::string::npos) << said;
  EXPECT_EQ(said.find("WRONG", at + 1), std::string::npos) << said;
  EXPECT_NE(place({"-o", path("placed.toml")}, 40), 0);
  EXPECT_NE(said.find("contradicts the others"), std::string::npos) << said;
  EXPECT_FALSE(std::filesystem::exists(path("placed.toml")));
}

std::string list_of(const std::vector<PrintedTag>& tags) {
  std::ostringstream list;
  list.precision(12);
  for (const PrintedTag& tag : tags) {
    list << tag.id << " = ";
    for (std::size_t k = 0; k < 4; ++k) {
      const optics::Vec3& c = tag.corners[k];
      list << (k > 0 ? ", " : "") << c.x << ", " << c.y << ", " << c.z;
    }
    list << "  # on the wall\n";
  }
  return list.str();
}

TEST_F(Place, PlacesACameraByTagsWithoutAClick) {
  std::mt19937_64 random(8);
  const TagScene scene = random_tag_scene(random, 320, 360, 800);
  machine = scene.rig;
  write("rig.toml", rig_text());
  write("ball.png", picture_of_tags(scene.rig, scene.rig.cameras[0], scene.tags, 2, random));
  write("tags.txt", list_of(scene.tags));
  ASSERT_EQ(run({"place", "--rig", path("rig.toml"), "--camera", "A", "--image", path("ball.png"),
                 "--tags", path("tags.txt"), "--json"}),
            0)
      << said;
  const auto camera = nlohmann::json::parse(said)["cameras"][0];
  EXPECT_EQ(camera["points"].size(), 16U);
  EXPECT_NEAR(camera["rotation"][1].get<double>(), machine.cameras[0].pose.rotation.row0.y, 5e-3);
  EXPECT_NEAR(camera["rotation"][8].get<double>(), machine.cameras[0].pose.rotation.row2.z, 5e-3);
}

TEST_F(Place, FindsTheBallOfAnUnplacedCamera) {
  std::mt19937_64 random(8);
  const TagScene scene = random_tag_scene(random, 320, 360, 800);
  machine = scene.rig;
  machine.cameras.assign(2, scene.rig.cameras[0]);
  write("rig.toml", rig_text(false));
  write("ball.png", picture_of_tags(scene.rig, scene.rig.cameras[0], scene.tags, 2, random));
  write("tags.txt", list_of(scene.tags));
  std::vector<std::string> words{
      "place", "--rig",   path("rig.toml"), "-o",     path("rig.toml"), "--camera",
      "A",     "--image", path("ball.png"), "--tags", path("tags.txt")};
  ASSERT_EQ(run(words), 0) << said;
  const auto one = app::files::load_rig(path("rig.toml"), app::files::Unplaced::Allowed);
  ASSERT_TRUE(one) << one.error().message;
  const optics::Mat3& found = one->cameras[0].pose->rotation;
  EXPECT_NEAR(found.row0.y, machine.cameras[0].pose.rotation.row0.y, 5e-3);
  EXPECT_NEAR(found.row2.z, machine.cameras[0].pose.rotation.row2.z, 5e-3);
  EXPECT_TRUE(is_unplaced(one->cameras[1])) << "not placed yet";
  EXPECT_FALSE(app::files::load_rig(path("rig.toml"))) << "other commands need both";
  words[6] = "B";
  ASSERT_EQ(run(words), 0) << said;
  const auto both = app::files::load_rig(path("rig.toml"));
  EXPECT_TRUE(both) << both.error().message;
}

TEST_F(Place, RefusesAPointBesideTheBall) {
  const RigCamera& camera = machine.cameras[0];
  const SeenLimb limb = limb_of(camera, machine.centre, machine.radius);
  const double angle = optics::radians(limb.angle);
  const auto at_limb = [&](double beyond) {
    char text[200];
    std::snprintf(text, sizeof text, "%.6f,%.6f=1,2,3",
                  limb.centre.u + (limb.rx + beyond) * std::cos(angle),
                  limb.centre.v + (limb.rx + beyond) * std::sin(angle));
    return std::string(text);
  };
  std::vector<std::string> words{"place", "--rig", path("rig.toml")};
  const auto marks = marked(0);
  words.insert(words.end(), marks.begin(), marks.end());
  words.insert(words.end(), {"--point", at_limb(5)});
  EXPECT_NE(run(words), 0);
  EXPECT_NE(said.find("(1, 2, 3 mm), marked at "), std::string::npos) << said;
  EXPECT_NE(said.find("px outside of the ball's outline"), std::string::npos) << said;
  for (const double beyond : {-0.3, 0.3}) {  // 0.3 px are an error of the mark or the outline
    words.back() = at_limb(beyond);
    run(words);
    EXPECT_EQ(said.find("outside"), std::string::npos) << said;
  }
}

TEST_F(Place, RefusesMistakesWithTheReason) {
  write("black.png", cv::Mat(2000, 2400, CV_8U, cv::Scalar(0)));
  write("small.png", cv::Mat(200, 300, CV_8U, cv::Scalar(0)));
  write("twice.txt", "3=120,0,0,500,1,0,0,0,1,0\n3=120,0,0,500,1,0,0,0,1,0\n");
  write("none.txt", "# tags\nthree\n");
  write("bare.toml", rig_text(false));
  write("lens.yaml",
        std::string(
            "image_width: 640\nimage_height: 480\ndistortion_model: plumb_bob\n"
            "camera_matrix: {rows: 3, cols: 3, data: [900, 0, 319.5, 0, 900, 239.5, 0, 0, 1]}\n"
            "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"));
  write("other.toml", std::string("[[camera]]\nname = \"A\"\nwidth = 800\nheight = 600\n"
                                  "[camera.intrinsics]\nfile = \"lens.yaml\"\n"));
  ASSERT_EQ(place({"-o", path("placed.toml")}), 0) << said;
  const std::string one = point(0, 0), two = point(0, 1);
  const auto with = [](std::vector<std::string> words) {
    words.insert(words.begin(), {"--rig", "DIR/rig.toml"});
    return words;
  };
  for (const Mistake& mistake : {
           Mistake{"no rig", {"--camera", "A"}, {"--rig"}},
           Mistake{"no camera", with({}), {"--camera"}},
           Mistake{"a point of no camera", with({"--point", one}), {"--point needs a --camera"}},
           Mistake{"an unknown camera", with({"--camera", "C"}), {"C", "A"}},
           Mistake{"a camera twice", with({"--camera", "A", "--camera", "A"}), {"twice"}},
           Mistake{"too few points", with({"--camera", "A", "--point", one}), {"2 are needed"}},
           Mistake{
               "too few for the centre",
               with({"--camera", "A", "--point", one, "--point", two, "--ball-centre", "unknown"}),
               {"need 4"}},
           Mistake{"half a point in a view",
                   with({"--camera", "A", "--view-point", "1,2"}),
                   {"--view-point", "U,V=X,Y,Z"}},
           Mistake{"half a point", with({"--camera", "A", "--point", "1,2"}), {"U,V=X,Y,Z"}},
           Mistake{"no number", with({"--camera", "A", "--point", "1,nan=1,2,3"}), {"U,V=X,Y,Z"}},
           Mistake{"a strange centre", with({"--ball-centre", "-3"}), {"known, unknown"}},
           Mistake{"no ball",
                   {"--rig", "DIR/placed.toml", "--camera", "A", "--image", "DIR/black.png"},
                   {"black.png"}},
           Mistake{"a view of an unplaced camera",
                   {"--rig", "DIR/bare.toml", "--camera", "A", "--view-point", "1,2=1,2,3"},
                   {"A has no place in the rig", "--point"}},
           Mistake{"an unplaced camera without a picture",
                   {"--rig", "DIR/bare.toml", "--camera", "A", "--point", one},
                   {"--image"}},
           Mistake{"an unplaced camera with a lens of another size",
                   {"--rig", "DIR/other.toml", "--camera", "A"},
                   {"other.toml:", "camera A", "the intrinsics are for 640x480"}},
           Mistake{"no outline", {"--rig", "DIR/placed.toml", "--camera", "A"}, {"--image"}},
           Mistake{"a tag without a picture",
                   with({"--camera", "A", "--tag", "3=120,0,0,500,1,0,0,0,1,0"}),
                   {"--image"}},
           Mistake{"half a tag", with({"--tag", "3=1,2,3"}), {"--tag", "ID="}},
           Mistake{"no such tag", with({"--tag", "600=120,0,0,500,1,0,0,0,1,0"}), {"36h11"}},
           Mistake{"a bent tag", with({"--tag", "3=0,0,0,9,0,0,9,9,0,0,5,0"}), {"not a square"}},
           Mistake{"a tag twice", with({"--tags", "DIR/twice.txt"}), {"tag 3", "twice"}},
           Mistake{"a list that is none", with({"--tags", "DIR/none.txt"}), {"none.txt:2"}},
           Mistake{
               "another size",
               with({"--camera", "A", "--image", "DIR/small.png"}),
               {"small.png: the picture is 300x200 px, but camera A of the rig has 2400x2000 px"}},
       }) {
    SCOPED_TRACE(mistake.name);
    expect_refused("place", mistake);
  }
}

}  // namespace
}  // namespace orbwatch::tests
