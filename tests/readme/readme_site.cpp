// SPDX-License-Identifier: Apache-2.0
#include "tests/readme/readme_site.h"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <sstream>
#include <string>

#include "tests/proc/align/place/mirrored_tags.h"

namespace orbwatch::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = ORBWATCH_SOURCE_DIR;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

void write(const fs::path& file, const cv::Mat& picture) {
  fs::create_directories(file.parent_path());
  EXPECT_TRUE(cv::imwrite(file.string(), picture)) << file;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Writes the photograph of the README's first command in its full size.
void write_photograph(const fs::path& folder) {
  const cv::Mat room = cv::imread((kSource / "tests/data/room.jpg").string());
  cv::Mat full;
  cv::resize(room, full, {4096, 4096}, 0, 0, cv::INTER_LINEAR);
  write(folder / "ball.jpg", full);
}

std::string camera_text(const std::string& name, const MirroredRig& rig) {
  const RigCamera& camera = rig.cameras.front();
  const SeenLimb limb = limb_of(camera, rig.centre, rig.radius);
  std::ostringstream out;
  out.precision(12);
  out << "[[camera]]\nname = \"" << name << "\"\nwidth = " << camera.width
      << "\nheight = " << camera.height << "\n[camera.intrinsics]\nfx = " << camera.focal
      << "\nfy = " << camera.focal << "\ncx = " << camera.middle().u
      << "\ncy = " << camera.middle().v << "\n[camera.outline]\ncentre = [" << limb.centre.u << ", "
      << limb.centre.v << "]\nradii = [" << limb.rx << ", " << limb.ry
      << "]\nangle = " << limb.angle << "\n";
  return out.str();
}

/// Writes pictures of cameras that show a ball and printed tags, and a folder of such pictures of
/// A.
void write_cameras(const fs::path& folder) {
  std::mt19937_64 random(8);
  const TagScene scene = random_tag_scene(random, 320, 360, 800);
  const cv::Mat picture = picture_of_tags(scene.rig, scene.rig.cameras[0], scene.tags, 2, random);
  write(folder / "left.png", picture);
  write(folder / "right.png", picture);
  for (int n = 0; n < 8; ++n) write(folder / "FOLDER" / (std::to_string(n) + ".png"), picture);
  const optics::Vec3& c = scene.rig.centre;
  std::ostringstream rig;
  rig.precision(12);
  rig << "[ball]\ncentre = [" << c.x << ", " << c.y << ", " << c.z
      << "]\nradius = " << scene.rig.radius << "\n";
  for (const char* name : {"left", "right", "A"}) rig << camera_text(name, scene.rig);
  write(folder / "rig.toml", rig.str());
  std::ostringstream tags;
  tags.precision(12);
  for (const PrintedTag& tag : scene.tags) {
    tags << tag.id << "=";
    for (std::size_t k = 0; k < 4; ++k) {
      const optics::Vec3& corner = tag.corners[k];
      tags << (k > 0 ? "," : "") << corner.x << "," << corner.y << "," << corner.z;
    }
    tags << "\n";
  }
  write(folder / "tags.txt", tags.str());
}

/// Writes the demo's simulated machine, with a state folder and ports of its own: as machine.toml,
/// as a configuration FILE, and changed as machine/site.toml.
void write_machine(const fs::path& folder) {
  const fs::path shipped = kSource / "platform/config";
  std::string site = text_of(shipped / "demo.toml");
  for (const auto& [part, instead] : std::vector<std::pair<std::string, std::string>>{
           {"port = 1502", "port = 0"}, {"[web]\n", "[web]\nport = 0\n"}}) {
    const std::size_t at = site.find(part);
    ASSERT_NE(at, std::string::npos) << part;
    site.replace(at, part.size(), instead);
  }
  site = "state_folder = \"" + (folder / "state").string() + "\"\n" + site;
  fs::create_directories(folder / "state");
  write(folder / "machine.toml", site);
  write(folder / "FILE", site);
  write(folder / "machine/site.toml", site + "\n# changed\n");
  for (const fs::path& where : {folder, folder / "machine"}) {
    for (const char* name : {"demo-rig.toml", "demo-recipe.toml"}) {
      fs::copy_file(shipped / name, where / name);
    }
  }
}

}  // namespace

void write_readme_files(const fs::path& folder) {
  write_photograph(folder);
  write_cameras(folder);
  write_machine(folder);
}

}  // namespace orbwatch::tests
