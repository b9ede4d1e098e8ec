// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/files/rig/camera_calibration.h"
#include "proc/image/picture.h"
#include "proc/optics/rig.h"
#include "proc/optics/rotation.h"
#include "proc/settings/settings.h"

/// Contents of a rig file, and its keys; rig_file.h converts it to an optics::Rig.
namespace orbwatch::app::files {

struct ObstacleSettings : optics::Box {
  std::string name;
};

struct SceneSettings : optics::Scene {
  std::vector<Located<ObstacleSettings>> named_obstacles;
};

struct IntrinsicsSettings {
  std::optional<std::filesystem::path> file;
  double fx = 0;
  double fy = 0;
  std::optional<double> cx;
  std::optional<double> cy;
  std::string distortion = "none";
  std::vector<double> coefficients;
};

/// Outline of the ball in a camera's picture, and the camera's orientation relative to the
/// reference.
struct OutlineSettings {
  std::array<double, 2> centre{};
  std::optional<double> radius;
  std::optional<std::array<double, 2>> radii;
  double angle = 0;
  std::optional<double> alpha;
  std::optional<double> distance;
  std::optional<std::array<double, 3>> rotation;
  std::optional<optics::Mat3> rotation_matrix;
  bool registered = true;
};

struct RigCameraSettings : optics::RigCamera {
  std::optional<Located<IntrinsicsSettings>> lens;
  std::optional<OutlineSettings> limb;
};

struct RigSettings {
  optics::Ball ball;
  Located<SceneSettings> scene;
  std::vector<Located<RigCameraSettings>> cameras;
};

/// The limb, from either form of the settings.
inline optics::Outline outline(const OutlineSettings& settings) {
  const double radius = settings.radius.value_or(0);
  const auto radii = settings.radii.value_or(std::array{radius, radius});
  return {{settings.centre[0], settings.centre[1]}, radii[0], radii[1], settings.angle};
}

/// The registration, from either form of the settings; none is the identity.
inline optics::Mat3 registration(const OutlineSettings& settings) {
  if (settings.rotation_matrix) return *settings.rotation_matrix;
  const auto [yaw, pitch, roll] = settings.rotation.value_or(std::array<double, 3>{});
  return optics::rotation({yaw, pitch, roll});
}

inline constexpr std::array kRooms{
    Word{"none", optics::Scene::Room::None}, Word{"sphere", optics::Scene::Room::Sphere},
    Word{"plane", optics::Scene::Room::Plane}, Word{"box", optics::Scene::Room::Box}};

inline constexpr std::size_t kMaxRigCameras = 16;
inline constexpr std::size_t kMaxObstacles = 16;

template <class Visitor>
void visit(Visitor& v, optics::Ball& ball) {
  v.required("centre", ball.centre, kAnyNumber, "Centre of the ball, machine frame, mm");
  v.required("radius", ball.radius, Range::above(0), "Radius of the ball, mm");
}

template <class Visitor>
void visit(Visitor& v, ObstacleSettings& obstacle) {
  v.required("name", obstacle.name, "Name for messages");
  v.required("low", obstacle.low, kAnyNumber, "Corner with the lowest x, y, z, mm");
  v.required("high", obstacle.high, kAnyNumber, "Corner with the highest x, y, z, mm");
}

template <class Visitor>
void visit(Visitor& v, SceneSettings& scene) {
  using Room = optics::Scene::Room;
  v.optional("room", scene.room, kRooms,
             "Surface that encloses the ball; none: everything but the obstacles is far away");
  const bool sphere = scene.room == Room::Sphere, plane = scene.room == Room::Plane,
             box = scene.room == Room::Box;
  v.required_if(sphere, "room sphere", "centre", scene.centre, kAnyNumber,
                "Centre of the sphere, mm");
  v.required_if(sphere, "room sphere", "radius", scene.radius, Range::above(0),
                "Radius of the sphere, mm");
  v.required_if(plane, "room plane", "point", scene.point, kAnyNumber,
                "Any point on the plane, mm");
  v.required_if(plane, "room plane", "normal", scene.normal, kAnyNumber,
                "Normal of the plane, any length, either side");
  v.required_if(box, "room box", "low", scene.walls.low, kAnyNumber,
                "Corner with the lowest x, y, z, mm");
  v.required_if(box, "room box", "high", scene.walls.high, kAnyNumber,
                "Corner with the highest x, y, z, mm");
  v.tables("obstacle", scene.named_obstacles, 0, kMaxObstacles,
           "Boxes within the room that hide what is behind them: table, spindle");
}

template <class Visitor>
void visit(Visitor& v, IntrinsicsSettings& lens) {
  v.optional(
      "file", lens.file,
      "Calibration file of OpenCV or ROS' camera_calibration, YAML; instead of the keys below");
  v.require(!lens.file || !lens.file->empty(), "file", "is empty; it must name a file");
  const bool here = !lens.file;
  const char* const when = "intrinsics without file";
  v.required_if(here, when, "fx", lens.fx, Range::above(0), "Focal length, px");
  v.required_if(here, when, "fy", lens.fy, Range::above(0), "Focal length, px");
  v.required_if(here, when, "cx", lens.cx, kAnyNumber,
                "Principal point, px, pixel centres at integers");
  v.required_if(here, when, "cy", lens.cy, kAnyNumber,
                "Principal point, px, pixel centres at integers");
  v.optional_if(here, when, "distortion", lens.distortion, kDistortionModels,
                "Distortion model by its ROS name; equidistant is OpenCV's fisheye");
  v.optional_if(
      here, when, "coefficients", lens.coefficients, kAnyNumber,
      "Distortion coefficients in OpenCV's order: plumb_bob k1 k2 p1 p2 [k3], rational_polynomial "
      "k1 k2 p1 p2 k3 k4 k5 k6, equidistant k1 k2 k3 k4; further ones must be 0");
}

template <class Visitor>
void visit(Visitor& v, OutlineSettings& outline) {
  v.required("centre", outline.centre, kAnyNumber, "Ball's centre in the picture, px: [u, v]");
  v.optional("radius", outline.radius, Range::above(0),
             "Radius of the ball's limb, px; for a circle");
  v.optional("radii", outline.radii, Range::above(0),
             "Semi-axes of the ball's limb, px; for an ellipse");
  v.optional("angle", outline.angle, kAnyNumber,
             "Angle of the first semi-axis, deg, from u towards v");
  v.optional("alpha", outline.alpha, Range::above(180, 360),
             "Reflected field of view, deg: 360 minus the ball's apparent diameter");
  v.optional("distance", outline.distance, Range::above(1),
             "Distance from the camera to the ball's centre, ball radii; instead of alpha");
  v.optional("rotation", outline.rotation, kAnyNumber,
             "Registration to the reference, deg: [yaw, pitch, roll]");
  v.optional("rotation_matrix", outline.rotation_matrix, kAnyNumber,
             "Registration as a 3x3 matrix by rows: v_reference = R v_camera; instead of rotation");
  v.optional("registered", outline.registered,
             "false: the registration is unknown, and merged and measured views omit the camera "
             "until it is registered");
  v.require(outline.registered || (!outline.rotation && !outline.rotation_matrix), "registered",
            "a camera with a rotation is registered; remove registered = false or the rotation");
  v.require(outline.radius.has_value() != outline.radii.has_value(), "radius",
            "set either radius or radii");
  v.require(!outline.rotation || !outline.rotation_matrix, "rotation_matrix",
            "set either rotation or rotation_matrix");
  const auto rotation = optics::checked_rotation(registration(outline));
  v.require(rotation.has_value(), "rotation_matrix", rotation ? "" : rotation.error().message);
}

template <class Visitor>
void visit(Visitor& v, optics::Pose& pose) {
  v.required("position", pose.position, kAnyNumber, "Position of the camera, machine frame, mm");
  v.required("rotation", pose.rotation, kAnyNumber,
             "3x3 matrix by rows: the camera's right, down and forward in the machine frame");
  const auto rotation = optics::checked_rotation(pose.rotation);
  v.require(rotation.has_value(), "rotation", rotation ? "" : rotation.error().message);
}

template <class Visitor>
void visit(Visitor& v, optics::Window& window) {
  v.required("normal", window.normal, kAnyNumber,
             "Normal of the glass, machine frame, any length, either side");
  v.required("thickness", window.thickness, Range::between(0, 1000), "Thickness of the glass, mm");
  v.optional("index", window.index, Range::between(1, 5), "Refractive index");
  const auto good = optics::check_window(window);
  v.require(good.has_value(), "normal", good ? "" : good.error().message);
}

template <class Visitor>
void visit(Visitor& v, RigCameraSettings& camera) {
  v.required("name", camera.name, "Camera name, used by commands and messages");
  v.required("width", camera.width, Range::between(1, kMaxSide), "Picture width, px");
  v.required("height", camera.height, Range::between(1, kMaxSide), "Picture height, px");
  v.optional("model", camera.model, optics::kBallModels, "Projection");
  v.table("intrinsics", camera.lens, "Calibrated lens");
  v.table("pose", camera.pose,
          "Measured position and orientation; needs intrinsics. Only `orbwatch place` accepts a "
          "camera with neither pose nor outline, to find its pose");
  v.table("outline", camera.limb,
          "The ball's outline in the camera's picture, instead of a pose. With intrinsics, the "
          "ball's direction and distance follow from the limb, and rotation turns the camera's own "
          "axes (X = -right, Y = -forward, Z = -down) into the machine frame. Without intrinsics, "
          "one of alpha and distance is needed (the classical model needs neither), and the camera "
          "is assumed to look straight at the ball");
  v.table("window", camera.window, "A flat glass between camera and ball; needs intrinsics");
}

template <class Visitor>
void visit(Visitor& v, RigSettings& rig) {
  v.table(
      "ball", rig.ball,
      "The mirror ball. Default: at the origin with radius 1, so that lengths are in ball radii");
  v.table("scene", rig.scene,
          "Surroundings that the ball reflects, as far as they are known. Default: everything is "
          "far away");
  v.tables("camera", rig.cameras, 1, kMaxRigCameras, "Cameras that look at the ball");
}

}  // namespace orbwatch::app::files
