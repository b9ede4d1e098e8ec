// SPDX-License-Identifier: Apache-2.0
#include "tests/support/rendered_scene.h"

#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <regex>
#include <sstream>

#include "proc/optics/vec.h"
#include "tests/support/reference_data.h"

namespace orbwatch::tests {
namespace {

using optics::Mat3;
using optics::Vec3;

Mat3 matrix(const cv::FileNode& n) {
  return {scene_vector(n[0]), scene_vector(n[1]), scene_vector(n[2])};
}

/// A list of numbers in TOML, with every digit.
std::string list(std::initializer_list<double> values) {
  std::ostringstream text;
  text.precision(17);
  text << '[';
  for (const double value : values) text << (text.tellp() > 1 ? ", " : "") << value;
  return text.str() + ']';
}
std::string list(const Vec3& v) { return list({v.x, v.y, v.z}); }
std::string list(const Mat3& m) {
  return list({m.row0.x, m.row0.y, m.row0.z, m.row1.x, m.row1.y, m.row1.z,  //
               m.row2.x, m.row2.y, m.row2.z});
}
std::string value(double number) {
  std::string text = list({number});
  return text.substr(1, text.size() - 2);
}

std::string head(const std::string& name, const cv::FileNode& camera) {
  return "[[camera]]\nname = \"" + name + "\"\nwidth = " + value(scene_number(camera["width"])) +
         "\nheight = " + value(scene_number(camera["height"])) + "\n";
}

std::string calibrated(const std::string& name, const cv::FileNode& camera) {
  return head(name, camera) + "[camera.intrinsics]\nfx = " + value(scene_number(camera["fx"])) +
         "\nfy = " + value(scene_number(camera["fy"])) +
         "\ncx = " + value(scene_number(camera["cx"]) - 0.5) +
         "\ncy = " + value(scene_number(camera["cy"]) - 0.5) +
         "\n[camera.pose]\nposition = " + list(scene_vector(camera["C"])) +
         "\nrotation = " + list(matrix(camera["R_wc"])) + "\n";
}

/// The registration of a camera that looks straight at the ball: from +Y of the ball along -Y,
/// image right = -X, image up = +Z. The smallest turn that points the true camera at the ball.
Mat3 registration(const cv::FileNode& camera, const Vec3& centre) {
  const Vec3 axis = optics::normalized(centre - scene_vector(camera["C"])), facing = -axis;
  const Mat3 axes = matrix(camera["R_wc"]);
  const double along = optics::dot(axes.row0, axis) / (1 + optics::dot(axes.row2, axis));
  const Vec3 right = axes.row0 - (axes.row2 + axis) * along;
  return optics::transposed({-right, facing, optics::cross(-right, facing)});
}

std::string uncalibrated(const std::string& name, const cv::FileNode& camera, const Vec3& centre) {
  const cv::FileNode outline = camera["outline"];
  return head(name, camera) + "[camera.outline]\ncentre = " +
         list({scene_number(outline["cx"]) - 0.5, scene_number(outline["cy"]) - 0.5}) +
         "\nradii = " +
         list({scene_number(outline["semi_major"]), scene_number(outline["semi_minor"])}) +
         "\nangle = " + value(scene_number(outline["major_axis_angle_deg"])) +
         "\nalpha = " + value(scene_number(camera["alpha_deg"])) +
         "\nrotation_matrix = " + list(registration(camera, centre)) + "\n";
}

}  // namespace

cv::FileStorage open_rendered_scene() {
  std::ifstream in(rendered_pictures() / "scene.json");
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  // OpenCV's reader does not support null.
  return {std::regex_replace(text, std::regex("\\bnull\\b"), "\"\""),
          cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_JSON};
}

std::filesystem::path rendered_pictures() { return reference_data() / "renders"; }

RenderedScene::RenderedScene(const std::string& name) {
  const cv::FileStorage file = open_rendered_scene();
  const cv::FileNode scene = file["scenes"][name];
  const Vec3 centre = scene_vector(file["ball"]["centre"]);
  const double scale = scene_number(scene["scale_about_ball_centre"]);
  const auto scaled = [&](const cv::FileNode& corner) {
    return list(centre + (scene_vector(corner) - centre) * scale);
  };
  ball_ = "[ball]\ncentre = " + list(centre) +
          "\nradius = " + value(scene_number(scene["ball_radius"])) + "\n";
  scene_ = "[scene]\nroom = \"box\"\nlow = " + scaled(file["box"]["lo"]) +
           "\nhigh = " + scaled(file["box"]["hi"]) +
           "\n[[scene.obstacle]]\nname = \"table\"\nlow = " + scaled(file["table"]["lo"]) +
           "\nhigh = " + scaled(file["table"]["hi"]) + "\n";
  for (const auto& camera : scene["cameras"]) {
    cameras_.push_back(
        {camera.name(), rendered_pictures() / static_cast<std::string>(camera["image"])});
    calibrated_.push_back(calibrated(camera.name(), camera));
    uncalibrated_.push_back(uncalibrated(camera.name(), camera, centre));
  }
  for (const auto& view : file["gt"]["views"]) {
    const bool thermal = !static_cast<std::string>(view["thermal"]).empty();
    views_.push_back({scene_number(view["yaw_deg"]), scene_number(view["pitch_deg"]),
                      scene_number(view["roll_deg"]), scene_number(view["hfov_deg"]),
                      static_cast<int>(view["width"]), static_cast<int>(view["height"]),
                      thermal ? static_cast<int>(view["thermal_size"][0]) : 0,
                      thermal ? static_cast<int>(view["thermal_size"][1]) : 0});
  }
}

std::string RenderedScene::rig(Known known) const {
  std::string text = ball_;
  if (known == Known::BoxAndTable) text += scene_;
  for (const std::string& camera : calibrated_) text += camera;
  return text;
}

std::string RenderedScene::uncalibrated_rig() const {
  std::string text = ball_;
  for (const std::string& camera : uncalibrated_) text += camera;
  return text;
}

}  // namespace orbwatch::tests
