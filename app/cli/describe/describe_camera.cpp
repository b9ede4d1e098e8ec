// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "app/cli/command.h"
#include "app/cli/options/camera_options.h"
#include "app/files/rig/camera_calibration.h"
#include "app/files/rig/rig_file.h"
#include "app/model/status/json.h"
#include "proc/optics/ball_model.h"
#include "proc/optics/vec.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kDescribeCameraNotes =
    "\n"
    "--json prints one object: camera, picture {width, height}, model, facing {yaw, pitch} (from "
    "the\n"
    "ball towards the camera, degrees), distance (ball radii), distance_mm, alpha (degrees), "
    "position\n"
    "[x, y, z] (mm, machine frame), outline {centre [u, v], radii [rx, ry], angle} (null: not "
    "wholly\n"
    "shown), lens {focal_lengths [fx, fy], principal_point [cx, cy], distortion, coefficients} "
    "(null:\n"
    "the rig has none). Distances and position are null where the model has none.\n";

struct DescribeCameraOptions {
  std::filesystem::path rig;
  std::string camera;
  /// None: text for people.
  std::optional<files::CalibrationFormat> format;
  bool json = false;
};

std::vector<Option> declare(DescribeCameraOptions& o) {
  using Format = std::optional<files::CalibrationFormat>;
  static constexpr std::array kFormats{Word{"text", Format{}},
                                       Word{"opencv", Format{files::CalibrationFormat::OpenCv}},
                                       Word{"ros", Format{files::CalibrationFormat::Ros}}};
  return {
      {"rig", 0, "RIG", "file that describes cameras, ball and machine", text_option(o.rig)},
      {"camera", 0, "NAME", "one of its cameras", text_option(o.camera)},
      {"format", 0, joined(kFormats),
       "text (default), or its calibration as OpenCV\nor ROS write it",
       word_option("format", kFormats, o.format)},
      {"json", 0, "", "for programs", flag_option(o.json)},
  };
}

using Json = nlohmann::ordered_json;

constexpr std::array kDistortions{Word{"none", optics::Distortion::None},
                                  Word{"pinhole", optics::Distortion::Pinhole},
                                  Word{"fisheye", optics::Distortion::Fisheye}};

std::size_t coefficient_count(optics::Distortion distortion) {
  switch (distortion) {
    case optics::Distortion::None:
      return 0;
    case optics::Distortion::Fisheye:
      return 4;
    case optics::Distortion::Pinhole:
      break;
  }
  return 8;
}

void write_lens(const optics::Intrinsics& lens, std::ostream& out) {
  out << "focal lengths    " << lens.fx << ", " << lens.fy << " px\n"
      << "principal point  " << lens.cx << ", " << lens.cy << " px\n"
      << "distortion       ";
  switch (lens.distortion) {
    case optics::Distortion::None:
      out << "none\n";
      return;
    case optics::Distortion::Pinhole:
      out << "pinhole, k1 k2 p1 p2 k3 k4 k5 k6:";
      break;
    case optics::Distortion::Fisheye:
      out << "fisheye, k1 k2 k3 k4:";
      break;
  }
  for (std::size_t i = 0; i < coefficient_count(lens.distortion); ++i)
    out << " " << lens.coefficients[i];
  out << "\n";
}

/// Position of the camera and its view of the ball, from the projection.
struct Place {
  explicit Place(const optics::BallProjection& ball)
      : yaw(optics::degrees(std::atan2(ball.facing().x, ball.facing().y))),
        pitch(optics::degrees(std::asin(ball.facing().z))),
        distance(ball.distance()),
        distance_mm(ball.distance() * ball.ball().radius),
        alpha(360 - 2 * optics::degrees(std::asin(1 / ball.distance()))),
        limb(ball.outline()) {
    if (std::isfinite(distance)) position = ball.ball().centre + ball.facing() * distance_mm;
  }

  double yaw, pitch;  ///< degrees, from the ball towards the camera
  double distance;    ///< ball radii; infinite for an orthographic model
  double distance_mm;
  double alpha;                          ///< degrees
  std::optional<optics::Vec3> position;  ///< mm, machine frame
  std::optional<optics::Outline> limb;   ///< set if the lens shows it wholly
};

void write_place(const Place& place, std::ostream& out) {
  out << "facing           yaw " << place.yaw << ", pitch " << place.pitch
      << " deg, from the ball towards the camera\n"
      << "distance         " << place.distance << " ball radii, " << place.distance_mm << " mm\n"
      << "alpha            " << place.alpha << " deg\n";
  if (const auto& position = place.position) {
    out << "position         " << position->x << ", " << position->y << ", " << position->z
        << " mm, machine frame\n";
  }
  if (const auto& limb = place.limb) {
    out << "outline          centre " << limb->centre.u << ", " << limb->centre.v << " px, axes "
        << limb->rx << ", " << limb->ry << " px, angle " << limb->angle << " deg\n";
  } else {
    out << "outline          not wholly shown by the lens\n";
  }
}

std::string camera_text(const optics::RigCamera& camera, const Place& place) {
  std::ostringstream out;
  out << std::setprecision(8) << "camera           " << camera.name << "\n"
      << "picture          " << camera.width << "x" << camera.height << " px\n"
      << "model            " << word_for(optics::kBallModels, camera.model) << "\n";
  write_place(place, out);
  if (camera.intrinsics) write_lens(*camera.intrinsics, out);
  return out.str();
}

Json lens_json(const optics::Intrinsics& lens) {
  Json coefficients = Json::array();
  for (std::size_t i = 0; i < coefficient_count(lens.distortion); ++i) {
    coefficients.push_back(lens.coefficients[i]);
  }
  return {{"focal_lengths", {lens.fx, lens.fy}},
          {"principal_point", {lens.cx, lens.cy}},
          {"distortion", word_for(kDistortions, lens.distortion)},
          {"coefficients", std::move(coefficients)}};
}

std::string camera_json(const optics::RigCamera& camera, const Place& place) {
  Json json{{"camera", camera.name},
            {"picture", {{"width", camera.width}, {"height", camera.height}}},
            {"model", word_for(optics::kBallModels, camera.model)},
            {"facing", {{"yaw", place.yaw}, {"pitch", place.pitch}}},
            {"distance", to_json(place.distance)},
            {"distance_mm", to_json(place.distance_mm)},
            {"alpha", place.alpha},
            {"position", nullptr},
            {"outline", nullptr},
            {"lens", nullptr}};
  if (const auto& at = place.position) json["position"] = {at->x, at->y, at->z};
  if (const auto& limb = place.limb) {
    json["outline"] = {{"centre", {limb->centre.u, limb->centre.v}},
                       {"radii", {limb->rx, limb->ry}},
                       {"angle", limb->angle}};
  }
  if (camera.intrinsics) json["lens"] = lens_json(*camera.intrinsics);
  return json.dump(2) + "\n";
}

CliResult<std::string> describe(const DescribeCameraOptions& o) {
  if (o.rig.empty()) return usage_error("--rig is missing");
  if (o.camera.empty()) return usage_error("--camera is missing");
  if (o.json && o.format) return usage_error("give --json or --format, not both");
  const auto rig = files::load_rig(o.rig);
  if (!rig) return tl::unexpected(rig.error());
  const auto camera = find_camera(*rig, o.camera);
  if (!camera) return fail(o.rig.string() + ": " + camera.error().message);
  if (o.format) {
    if (camera->intrinsics) {
      return calibration_text(*camera->intrinsics, camera->name, *o.format);
    }
    return fail(o.rig.string() + ": camera " + camera->name + " has no intrinsics");
  }
  const auto ball = optics::ball_projection(*rig, *camera);
  if (!ball) return fail(o.rig.string() + ": " + ball.error().message);
  const Place place(*ball);
  return o.json ? camera_json(*camera, place) : camera_text(*camera, place);
}

}  // namespace

CliResult<std::string> describe_camera(const Arguments& arguments) {
  DescribeCameraOptions o;
  return run_command(
      arguments,
      {.usage = "Usage: orbwatch describe camera --rig RIG --camera NAME [options]\n\n"
                "Prints what follows from a rig for one camera.\n\n",
       .options = declare(o),
       .notes = kDescribeCameraNotes},
      [&](const auto&) { return describe(o); });
}

}  // namespace orbwatch::app::cli
