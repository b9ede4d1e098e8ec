// SPDX-License-Identifier: Apache-2.0
#include "tests/app/alignment/installed_machine.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "app/simulation/scene/static_scene.h"
#include "hal/frame/frame_pool.h"
#include "proc/align/register/registration.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::app::tests {
namespace {

using optics::Vec3;
using simulation::MachineSettings;
using simulation::Pinhole;

constexpr double kFrameRate = 15;
constexpr double kKelvinPerCount = 0.04;
constexpr double kTurnedDeg = 10, kLargerShare = 0.05;
constexpr double kClearDeg = 150;  // from the camera; directions behind are crowded at the limb
constexpr std::array kNames{"colour", "thermal"};

double any(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 any_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return optics::normalized({x, y, z});
}

/// Mount of a camera, around the demo's.
struct Mount {
  Vec3 towards;              ///< from the ball
  double nearest, farthest;  ///< ball radii
  double roll;               ///< degrees, at most
  int width, height;
};

constexpr Mount kColourMount{{88.6, -590.5, 59}, 9, 14, 5, 800, 800};
constexpr Mount kThermalMount{{-70.6, 335.4, 70.6}, 6, 9, 20, 320, 256};

Pinhole mounted(const Mount& mount, const simulation::Sphere& ball, std::mt19937_64& random) {
  const double degree = std::numbers::pi / 180;
  const Vec3 level = optics::normalized(mount.towards);
  const double turn = any(random, -15, 15) * degree, rise = any(random, -6, 10) * degree;
  const Vec3 beside{level.x * std::cos(turn) - level.y * std::sin(turn),
                    level.x * std::sin(turn) + level.y * std::cos(turn), level.z + std::sin(rise)};
  const double distance = any(random, mount.nearest, mount.farthest) * ball.radius;
  const double half = std::asin(ball.radius / distance);
  const double filled = any(random, 0.78, 0.9);  // share of the picture's height
  const double fov = 2 * std::atan(std::tan(half) * mount.width / (filled * mount.height)) / degree;
  const Vec3 beside_centre = any_direction(random) * (0.08 * ball.radius);
  Pinhole camera = simulation::look_at(ball.centre + optics::normalized(beside) * distance,
                                       ball.centre + beside_centre, fov, mount.width, mount.height);
  const double roll = any(random, -mount.roll, mount.roll) * degree;
  const optics::Mat3 upright = camera.rotation;
  camera.rotation.row0 = upright.row0 * std::cos(roll) + upright.row1 * std::sin(roll);
  camera.rotation.row1 = upright.row1 * std::cos(roll) - upright.row0 * std::sin(roll);
  return camera;
}

MachineSettings any_machine(std::uint64_t seed, std::mt19937_64& random) {
  MachineSettings settings;
  settings.seed = seed;
  const double x = any(random, -40, 40), y = any(random, -40, 40), z = any(random, -40, 40);
  settings.ball.centre = settings.ball.centre + Vec3{x, y, z};
  settings.ball.radius = any(random, 40, 60);
  return settings;
}

std::vector<Vec3> corners_of(const simulation::Box& box) {
  std::vector<Vec3> corners;
  for (const double x : {box.lo.x, box.hi.x}) {
    for (const double y : {box.lo.y, box.hi.y}) {
      for (const double z : {box.lo.z, box.hi.z}) corners.push_back({x, y, z});
    }
  }
  return corners;
}

template <class Sample>
void add_noise(const simulation::SensorNoise& noise, hal::FrameBuffer& buffer,
               std::uint64_t frame) {
  const auto samples = buffer.picture.samples<Sample>();
  const auto per_row = static_cast<std::size_t>(samples.stride);
  auto* const first = reinterpret_cast<Sample*>(buffer.memory);
  for (int row = 0; row < samples.height; ++row) {
    const auto number = static_cast<std::size_t>(row);
    noise.add(std::span(first + number * per_row, per_row), frame, number);
  }
}

}  // namespace

InstalledMachine::InstalledMachine(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  machine_ = simulation::Machine::make(any_machine(seed, random), {}).value();
  const simulation::Sphere& ball = machine_->settings().ball;
  cameras_ = {mounted(kColourMount, ball, random), mounted(kThermalMount, ball, random)};
  stated_ = true_rig();
  for (std::size_t n = 0; n < cameras_.size(); ++n) {
    optics::RigCamera& camera = stated_.cameras[n];
    camera = align::by_outline(stated_, camera).value();
    optics::Outline& outline = *camera.outline;
    const double larger = any(random, 0, 1) < 0.5 ? 1 - kLargerShare : 1 + kLargerShare;
    outline.centre.u += any(random, -kLargerShare, kLargerShare) * outline.rx;
    outline.centre.v += any(random, -kLargerShare, kLargerShare) * outline.rx;
    outline.rx *= larger;
    outline.ry *= larger;
    if (n == kThermal) {
      const double angle = kTurnedDeg * std::numbers::pi / 180;
      camera.registration =
          align::rotation_about(any_direction(random) * angle) * camera.registration;
    }
  }
}

optics::Rig InstalledMachine::true_rig() const {
  const MachineSettings& settings = machine_->settings();
  optics::Rig rig;
  rig.ball = {settings.ball.centre, settings.ball.radius};
  rig.scene.room = optics::Scene::Room::Box;
  rig.scene.walls = {settings.enclosure.lo, settings.enclosure.hi};
  for (const simulation::Box& box : {settings.table, settings.workpiece}) {
    rig.scene.obstacles.push_back({box.lo, box.hi});
  }
  for (std::size_t n = 0; n < cameras_.size(); ++n) {
    const Pinhole& pinhole = cameras_[n];
    optics::RigCamera camera;
    camera.name = kNames[n];
    camera.width = pinhole.width;
    camera.height = pinhole.height;
    camera.intrinsics = optics::Intrinsics{pinhole.width,
                                           pinhole.height,
                                           pinhole.focal_length,
                                           pinhole.focal_length,
                                           pinhole.cx(),
                                           pinhole.cy(),
                                           {},
                                           {}};
    camera.pose = optics::Pose{pinhole.rotation, pinhole.position};
    rig.cameras.push_back(camera);
  }
  return rig;
}

Vec3 InstalledMachine::work_piece() const {
  const simulation::Box& box = machine_->settings().workpiece;
  return {(box.lo.x + box.hi.x) / 2, (box.lo.y + box.hi.y) / 2, box.hi.z};
}

/// Both angles to the sphere's normal are the same at the point of reflection.
optics::Vec2 InstalledMachine::seen_at(std::size_t camera, const Vec3& point) const {
  const simulation::Sphere& ball = machine_->settings().ball;
  const Pinhole& pinhole = cameras_[camera];
  const Vec3 eye = pinhole.position - ball.centre, seen = point - ball.centre;
  const Vec3 forward = optics::normalized(eye);
  const Vec3 across = optics::normalized(seen - forward * dot(seen, forward));
  double low = 0, high = std::acos(ball.radius / norm(eye));
  for (int n = 0; n < 60; ++n) {
    const double angle = (low + high) / 2;
    const Vec3 normal = forward * std::cos(angle) + across * std::sin(angle);
    const Vec3 along = across * std::cos(angle) - forward * std::sin(angle);
    const auto from_normal = [&](const Vec3& end, double side) {
      const Vec3 ray = end - normal * ball.radius;
      return std::atan2(side * dot(ray, along), dot(ray, normal));
    };
    (from_normal(eye, -1) < from_normal(seen, 1) ? low : high) = angle;
  }
  const Vec3 spot = (forward * std::cos(low) + across * std::sin(low)) * ball.radius;
  const Vec3 c = pinhole.rotation * (spot - eye);
  return {pinhole.focal_length * c.x / c.z + pinhole.cx(),
          pinhole.focal_length * c.y / c.z + pinhole.cy()};
}

bool InstalledMachine::is_clear(std::size_t camera, const Vec3& point) const {
  const MachineSettings& settings = machine_->settings();
  const Vec3 towards = point - settings.ball.centre;
  const Vec3 to_camera = optics::normalized(cameras_[camera].position - settings.ball.centre);
  const double distance = norm(towards);
  if (dot(towards, to_camera) < std::cos(kClearDeg * std::numbers::pi / 180) * distance)
    return false;
  const auto hit =
      simulation::nearest_static(settings, {settings.ball.centre, towards * (1 / distance)});
  return hit.distance > distance - 2;  // mm
}

std::vector<ShownPoint> InstalledMachine::corners(std::size_t camera, std::size_t count,
                                                  std::mt19937_64& random) const {
  const MachineSettings& settings = machine_->settings();
  std::vector<ShownPoint> clear;
  for (const simulation::Box& box : {settings.enclosure, settings.table, settings.workpiece}) {
    for (const Vec3& point : corners_of(box)) {
      if (is_clear(camera, point)) clear.push_back({point, seen_at(camera, point)});
    }
  }
  std::ranges::shuffle(clear, random);
  // Each next one is the farthest from those that are chosen, in the picture.
  for (std::size_t n = 1; n < std::min(count, clear.size()); ++n) {
    const auto apart = [&](const ShownPoint& one) {
      double nearest = simulation::kNever;
      for (const ShownPoint& other : std::span(clear).first(n)) {
        nearest =
            std::min(nearest, std::hypot(one.pixel.u - other.pixel.u, one.pixel.v - other.pixel.v));
      }
      return nearest;
    };
    const auto rest = std::span(clear).subspan(n);
    std::swap(clear[n], *std::ranges::max_element(rest, {}, apart));
  }
  if (clear.size() > count) clear.resize(count);
  return clear;
}

RenderedCameras::RenderedCameras(const InstalledMachine& installed, std::uint64_t seed) {
  for (const std::size_t camera : {InstalledMachine::kColour, InstalledMachine::kThermal}) {
    const bool is_thermal = camera == InstalledMachine::kThermal;
    cameras_[camera] = installed.camera(camera);
    renderers_.emplace_back(installed.machine(), cameras_[camera],
                            simulation::Sensor{is_thermal ? simulation::CameraKind::Thermal
                                                          : simulation::CameraKind::Colour,
                                               kKelvinPerCount, 0});
    const auto channels = static_cast<std::size_t>(info(renderers_.back().format()).channels());
    noises_.emplace_back(1, seed + camera,
                         static_cast<std::size_t>(cameras_[camera].width) * channels);
  }
}

RecordedPicture RenderedCameras::picture(std::size_t camera) const {
  hal::FrameBuffer buffer;
  const simulation::Renderer& renderer = renderers_[camera];
  hal::allocate_picture(buffer, renderer.format(), cameras_[camera].width, cameras_[camera].height);
  const double seconds = static_cast<double>(frame_) / kFrameRate;
  renderer.render(seconds, buffer.memory);
  if (camera == InstalledMachine::kThermal) {
    add_noise<std::uint16_t>(noises_[camera], buffer, frame_);
  } else {
    add_noise<std::uint8_t>(noises_[camera], buffer, frame_);
  }
  return copied(buffer.picture, std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9)));
}

Result<std::vector<std::vector<RecordedPicture>>> RenderedCameras::record(
    const std::vector<std::size_t>& cameras, std::size_t count, std::chrono::seconds /*patience*/,
    const align::WorkProgress& progress) {
  std::vector<std::vector<RecordedPicture>> records(cameras.size());
  for (std::size_t n = 0; n < count; ++n, ++frame_) {
    const double share = static_cast<double>(n) / static_cast<double>(count);
    if (auto wanted = progress.at(align::WorkStep::Record, share); !wanted) {
      return tl::unexpected(wanted.error());
    }
    for (std::size_t k = 0; k < cameras.size(); ++k) records[k].push_back(picture(cameras[k]));
  }
  return records;
}

void RenderedCameras::ask(std::size_t camera, std::function<void(RecordedPicture)> reader) {
  reader(picture(camera));
}

void RenderedCameras::ask_together(
    std::vector<std::size_t> cameras,
    std::function<void(Result<std::vector<RecordedPicture>>)> reader) {
  std::vector<RecordedPicture> pictures;
  for (const std::size_t camera : cameras) pictures.push_back(picture(camera));
  reader(std::move(pictures));
}

}  // namespace orbwatch::app::tests
