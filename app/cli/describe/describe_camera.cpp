#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <optional>
#include <sstream>

#include "app/cli/command.h"
#include "app/cli/options/camera_options.h"
#include "app/files/camera_calibration.h"
#include "app/files/rig_file.h"
#include "proc/optics/ball_model.h"
#include "proc/optics/vec.h"

namespace orbwatch::app {
namespace {

struct DescribeCameraOptions {
  std::filesystem::path rig;
  std::string camera;
  /// None: text for people.
  std::optional<CalibrationFormat> format;
};

std::vector<Option> declare(DescribeCameraOptions& o) {
  using Format = std::optional<CalibrationFormat>;
  static constexpr std::array kFormats{Word{"text", Format{}},
                                       Word{"opencv", Format{CalibrationFormat::OpenCv}},
                                       Word{"ros", Format{CalibrationFormat::Ros}}};
  return {
      {"rig", 0, "RIG", "file that describes cameras, ball and machine", text_option(o.rig)},
      {"camera", 0, "NAME", "one of its cameras", text_option(o.camera)},
      {"format", 0, joined(kFormats),
       "text (default), or its calibration as OpenCV\nor ROS write it",
       word_option("format", kFormats, o.format)},
  };
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
  const std::size_t count = lens.distortion == optics::Distortion::Fisheye ? 4 : 8;
  for (std::size_t i = 0; i < count; ++i) out << " " << lens.coefficients[i];
  out << "\n";
}

/// Where the camera stands and how it sees the ball, as the projection has it.
void write_place(const optics::BallProjection& ball, std::ostream& out) {
  const optics::Vec3& facing = ball.facing();
  out << "facing           yaw " << optics::degrees(std::atan2(facing.x, facing.y)) << ", pitch "
      << optics::degrees(std::asin(facing.z)) << " deg, from the ball towards the camera\n"
      << "distance         " << ball.distance() << " ball radii, "
      << ball.distance() * ball.ball().radius << " mm\n"
      << "alpha            " << 360 - 2 * optics::degrees(std::asin(1 / ball.distance()))
      << " deg\n";
  if (std::isfinite(ball.distance())) {
    const optics::Vec3 position =
        ball.ball().centre + facing * (ball.distance() * ball.ball().radius);
    out << "position         " << position.x << ", " << position.y << ", " << position.z
        << " mm, machine frame\n";
  }
  if (const auto limb = ball.outline()) {
    out << "outline          centre " << limb->centre.u << ", " << limb->centre.v << " px, axes "
        << limb->rx << ", " << limb->ry << " px, angle " << limb->angle << " deg\n";
  } else {
    out << "outline          not wholly shown by the lens\n";
  }
}

Result<std::string> describe(const DescribeCameraOptions& o) {
  if (o.rig.empty()) return usage_error("--rig is missing");
  if (o.camera.empty()) return usage_error("--camera is missing");
  const auto rig = load_rig(o.rig);
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
  std::ostringstream out;
  out << std::setprecision(8) << "camera           " << camera->name << "\n"
      << "picture          " << camera->width << "x" << camera->height << " px\n"
      << "model            " << word_for(optics::kBallModels, camera->model) << "\n";
  write_place(*ball, out);
  if (camera->intrinsics) write_lens(*camera->intrinsics, out);
  return out.str();
}

}  // namespace

Result<std::string> describe_camera(const std::vector<std::string>& arguments) {
  DescribeCameraOptions o;
  return run_command(
      arguments,
      {.usage = "Usage: orbwatch describe camera --rig RIG --camera NAME [options]\n\n"
                "Prints what follows from a rig for one camera.\n\n",
       .options = declare(o)},
      [&](const auto&) { return describe(o); });
}

}  // namespace orbwatch::app
