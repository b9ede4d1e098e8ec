// SPDX-License-Identifier: Apache-2.0
#include "tests/proc/align/place/mirrored_rig.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

namespace orbwatch::tests {
namespace {

using align::BallCentre;
using optics::Mat3;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector3d eigen(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 vec3(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Mat3 turned(const Vec3& turn, const Mat3& rotation) {
  const Eigen::Vector3d axis = eigen(turn);
  const double angle = axis.norm();
  if (angle == 0) return rotation;
  const Eigen::AngleAxisd by(angle, axis / angle);
  return transposed(Mat3{vec3(by * eigen(rotation.column0())), vec3(by * eigen(rotation.column1())),
                         vec3(by * eigen(rotation.column2()))});
}

Vec3 any_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return normalized(Vec3{normal(random), normal(random), normal(random)});
}

double in(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

RigCamera random_camera(std::mt19937_64& random, const MirroredRig& rig, const RigWishes& wishes) {
  RigCamera camera;
  camera.width = 2400;
  camera.height = 2000;
  const double distance = std::exp(in(random, std::log(4), std::log(25)));
  const double radius = in(random, wishes.least_radius, wishes.most_radius);
  camera.focal = radius * std::sqrt(distance * distance - 1);
  const Vec3 towards = any_direction(random);
  // The offset keeps the ball's picture within the camera's.
  const double most = std::max(0.0, 0.5 * camera.height - radius) / camera.focal;
  const Vec3 aside = normalized(cross(towards, any_direction(random)));
  const Vec3 forward = normalized(towards + aside * in(random, 0, std::min(0.4, most)));
  const Vec3 right = normalized(cross(forward, any_direction(random)));
  camera.pose = {{right, cross(forward, right), forward},
                 rig.centre - towards * (distance * rig.radius)};
  return camera;
}

/// True if the camera's ball shows a direction clearly: not next to the limb.
bool shows(const RigCamera& camera, const MirroredRig& rig, const Vec3& direction) {
  const Vec3 facing = normalized(camera.pose.position - rig.centre);
  return dot(direction, facing) > std::cos(optics::radians(140));
}

/// All parameters that determine the measurements, as one vector: per camera rotation (3), position
/// (3), logarithm of the focal length (1); ball's centre (3); points (3 each).
struct Changed {
  MirroredRig rig;

  Changed(const MirroredRig& truth, Eigen::Index parameter, double step) : rig(truth) {
    const auto cameras = Eigen::Index(rig.cameras.size());
    const auto add = [step](Vec3& v, Eigen::Index k) {
      (k == 0 ? v.x : k == 1 ? v.y : v.z) += step;
    };
    if (parameter < 7 * cameras) {
      RigCamera& camera = rig.cameras[std::size_t(parameter / 7)];
      const Eigen::Index k = parameter % 7;
      Vec3 turn;
      if (k < 3) add(turn, k);
      camera.pose.rotation = turned(turn, camera.pose.rotation);
      if (k >= 3 && k < 6) add(camera.pose.position, k - 3);
      if (k == 6) camera.focal *= std::exp(step);
    } else if (parameter < 7 * cameras + 3) {
      add(rig.centre, parameter - 7 * cameras);
    } else {
      const Eigen::Index k = parameter - 7 * cameras - 3;
      add(rig.points[std::size_t(k / 3)], k % 3);
    }
  }
};

/// A step of that parameter that is small and still far above rounding.
double step_of(const MirroredRig& rig, Eigen::Index parameter) {
  const auto cameras = Eigen::Index(rig.cameras.size());
  const bool is_length = parameter >= 7 * cameras || (parameter % 7 >= 3 && parameter % 7 < 6);
  return is_length ? 1e-5 * rig.radius : 1e-6;
}

/// The measurements: marks and limbs.
Eigen::VectorXd measured(const MirroredRig& rig) {
  std::vector<double> all;
  for (const RigCamera& camera : rig.cameras) {
    for (const Vec3& point : rig.points) {
      const Vec2 pixel = seen_at(camera, rig.centre, rig.radius, point);
      all.insert(all.end(), {pixel.u, pixel.v});
    }
    const SeenLimb limb = limb_of(camera, rig.centre, rig.radius);
    all.insert(all.end(), {limb.centre.u, limb.centre.v, (limb.rx + limb.ry) / 2});
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), Eigen::Index(all.size()));
}

Eigen::VectorXd sigmas(const MirroredRig& rig, const Noise& noise) {
  std::vector<double> all;
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    all.insert(all.end(), 2 * rig.points.size(), noise.px);
    all.insert(all.end(), 3, noise.outline_px);
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), Eigen::Index(all.size()));
}

/// Directions all over the sphere, each for the same solid angle.
std::vector<Vec3> lattice() {
  constexpr int kRings = 16;
  std::vector<Vec3> all;
  for (int r = 0; r < kRings; ++r) {
    const double polar = (r + 0.5) * std::numbers::pi / kRings;
    const int count = std::max(1, int(std::lround(2 * kRings * std::sin(polar))));
    for (int n = 0; n < count; ++n) {
      const double a = 2 * std::numbers::pi * (n + 0.5) / count;
      all.push_back(
          {std::sin(polar) * std::cos(a), std::sin(polar) * std::sin(a), std::cos(polar)});
    }
  }
  return all;
}

/// The pixels of the view over which errors are averaged: directions far away.
std::vector<Vec2> view_pixels(const MirroredRig& rig, const RigCamera& camera) {
  const Vec3 facing = normalized(camera.pose.position - rig.centre);
  std::vector<Vec2> all;
  for (const Vec3& direction : lattice()) {
    if (dot(direction, facing) < std::cos(optics::radians(150))) continue;
    const Vec2 pixel =
        seen_at(camera, rig.centre, rig.radius, rig.centre + direction * (1e9 * rig.radius));
    const bool inside = pixel.u >= -0.5 && pixel.u <= camera.width - 0.5 && pixel.v >= -0.5 &&
                        pixel.v <= camera.height - 0.5;
    if (inside) all.push_back(pixel);
  }
  return all;
}

}  // namespace

Vec2 seen_at(const RigCamera& camera, const Vec3& centre, double radius, const Vec3& point) {
  const Real scale = 1 / Real(radius);
  const RealVec3 from_ball = (RealVec3(point) - RealVec3(centre)) * scale;
  const RealVec3 eye = (RealVec3(camera.pose.position) - RealVec3(centre)) * scale;
  const auto ray = fermat_ray(eye, {normalized(from_ball), norm(from_ball)});
  if (!ray) return {kNaN, kNaN};
  const Mat3& axes = camera.pose.rotation;
  const Real depth = dot(RealVec3(axes.row2), *ray);
  if (!(depth > 0)) return {kNaN, kNaN};
  return {double(camera.focal * dot(RealVec3(axes.row0), *ray) / depth + camera.middle().u),
          double(camera.focal * dot(RealVec3(axes.row1), *ray) / depth + camera.middle().v)};
}

SeenLimb limb_of(const RigCamera& camera, const Vec3& centre, double radius) {
  // The cone of tangents around the ball's direction, cut by the picture's plane: its long axis
  // points away from the principal point.
  const Vec3 ball = camera.pose.rotation * (centre - camera.pose.position);
  const double off_axis = std::atan2(std::hypot(ball.x, ball.y), ball.z);
  const double half = std::asin(radius / norm(ball));
  const double outer = std::tan(off_axis + half), inner = std::tan(off_axis - half);
  const double angle = std::atan2(ball.y, ball.x);
  const double away = camera.focal * (outer + inner) / 2;
  const double cut = std::sqrt(std::pow(std::cos(off_axis), 2) - std::pow(std::sin(half), 2));
  return {{camera.middle().u + away * std::cos(angle), camera.middle().v + away * std::sin(angle)},
          camera.focal * (outer - inner) / 2,
          camera.focal * std::sin(half) / cut,
          optics::degrees(angle)};
}

Vec3 direction_at(const RigCamera& camera, const Vec3& centre, double radius, const Vec2& pixel) {
  const Mat3& axes = camera.pose.rotation;
  const RealVec3 ray =
      normalized(RealVec3(axes.row0) * Real((pixel.u - camera.middle().u) / camera.focal) +
                 RealVec3(axes.row1) * Real((pixel.v - camera.middle().v) / camera.focal) +
                 RealVec3(axes.row2));
  const auto out =
      reflected({(RealVec3(camera.pose.position) - RealVec3(centre)) * (1 / Real(radius)), ray});
  return out ? rounded(out->direction) : Vec3{kNaN, kNaN, kNaN};
}

MirroredRig random_rig(std::mt19937_64& random, const RigWishes& wishes) {
  MirroredRig rig;
  rig.centre = {in(random, -300, 300), in(random, -300, 300), in(random, 100, 600)};
  rig.radius = in(random, 20, 80);
  for (int c = 0; c < wishes.cameras; ++c) {
    rig.cameras.push_back(random_camera(random, rig, wishes));
  }
  while (int(rig.points.size()) < wishes.points) {
    const Vec3 direction = any_direction(random);
    const auto shown = [&](const RigCamera& camera) { return shows(camera, rig, direction); };
    if (!std::ranges::all_of(rig.cameras, shown)) continue;
    rig.points.push_back(rig.centre + direction * (in(random, 3, 12) * rig.radius));
  }
  return rig;
}

align::PlaceRequest request_of(const MirroredRig& rig, const Noise& noise,
                               BallCentre::Knowledge knowledge, bool focal_unknown,
                               std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const auto off = [&](double sigma) { return sigma * normal(random); };
  const auto moved = [&](const Vec3& v, double sigma) {
    return v + Vec3{off(sigma), off(sigma), off(sigma)};
  };
  align::PlaceRequest request;
  request.ball_radius = rig.radius;
  request.centre = {knowledge, rig.centre, 0};
  if (knowledge == BallCentre::Knowledge::Measured) {
    request.centre = {knowledge, moved(rig.centre, noise.centre_mm), noise.centre_mm};
  } else if (knowledge == BallCentre::Knowledge::Unknown) {
    request.centre.position = {};
  }
  request.sigma_px = noise.px;
  request.sigma_mm = noise.mm;
  for (const Vec3& point : rig.points) request.points.push_back(moved(point, noise.mm));
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    const RigCamera& camera = rig.cameras[c];
    align::UnplacedCamera unplaced;
    unplaced.name = std::string(1, char('A' + c));
    unplaced.lens = camera.lens();
    unplaced.focal_unknown = focal_unknown;
    const SeenLimb limb = limb_of(camera, rig.centre, rig.radius);
    const double larger = off(noise.outline_px);
    unplaced.outline = {
        {limb.centre.u + off(noise.outline_px), limb.centre.v + off(noise.outline_px)},
        limb.rx + larger,
        limb.ry + larger,
        limb.angle};
    unplaced.outline_sigma = noise.outline_px;
    for (std::size_t p = 0; p < rig.points.size(); ++p) {
      const Vec2 pixel = seen_at(camera, rig.centre, rig.radius, rig.points[p]);
      unplaced.marks.push_back({p, {pixel.u + off(noise.px), pixel.v + off(noise.px)}});
    }
    request.cameras.push_back(unplaced);
  }
  return request;
}

Eigen::Matrix<double, 6, 1> pose_error(const RigCamera& truth, const optics::Pose& placed) {
  const Mat3 m = placed.rotation * transposed(truth.pose.rotation);
  Eigen::Matrix3d turn;
  turn << m.row0.x, m.row0.y, m.row0.z, m.row1.x, m.row1.y, m.row1.z, m.row2.x, m.row2.y, m.row2.z;
  const Eigen::AngleAxisd by(turn);
  Eigen::Matrix<double, 6, 1> error;
  error << by.angle() * by.axis(), eigen(placed.position - truth.pose.position);
  return error;
}

double direction_error(const MirroredRig& rig, std::size_t camera,
                       const align::Placement& placement) {
  const RigCamera& truth = rig.cameras[camera];
  const align::PlacedCamera& placed = placement.cameras[camera];
  const RigCamera found{placed.pose, placed.lens.fx, truth.width, truth.height};
  double sum = 0;
  int count = 0;
  for (const Vec2& pixel : view_pixels(rig, truth)) {
    const Vec3 right = direction_at(truth, rig.centre, rig.radius, pixel);
    const Vec3 taken = direction_at(found, placement.ball_centre, rig.radius, pixel);
    sum += std::pow(optics::degrees(optics::angle_between(right, taken)), 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

double least_direction_error(const MirroredRig& rig, const Noise& noise,
                             BallCentre::Knowledge knowledge, bool focal_unknown,
                             std::size_t camera) {
  const auto cameras = Eigen::Index(rig.cameras.size());
  const Eigen::Index centre = 7 * cameras;
  const Eigen::Index count = centre + 3 + 3 * Eigen::Index(rig.points.size());
  std::vector<Eigen::Index> unknown;
  for (Eigen::Index k = 0; k < count; ++k) {
    const bool is_focal = k < centre && k % 7 == 6;
    const bool is_centre = k >= centre && k < centre + 3, is_point = k >= centre + 3;
    if ((is_focal && !focal_unknown) || (is_point && noise.mm == 0) ||
        (is_centre && knowledge == BallCentre::Knowledge::Known)) {
      continue;
    }
    unknown.push_back(k);
  }
  const auto size = Eigen::Index(unknown.size());
  const std::vector<Vec2> pixels = view_pixels(rig, rig.cameras[camera]);
  const Eigen::VectorXd sigma = sigmas(rig, noise);
  Eigen::MatrixXd slopes(sigma.size(), size), view(3 * Eigen::Index(pixels.size()), size);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::Index parameter = unknown[std::size_t(k)];
    const double step = step_of(rig, parameter);
    const MirroredRig ahead = Changed(rig, parameter, step).rig;
    const MirroredRig behind = Changed(rig, parameter, -step).rig;
    slopes.col(k) = (measured(ahead) - measured(behind)).cwiseQuotient(sigma) / (2 * step);
    for (std::size_t n = 0; n < pixels.size(); ++n) {
      const Vec3 change =
          direction_at(ahead.cameras[camera], ahead.centre, rig.radius, pixels[n]) -
          direction_at(behind.cameras[camera], behind.centre, rig.radius, pixels[n]);
      view.block<3, 1>(3 * Eigen::Index(n), k) = eigen(change) / (2 * step);
    }
    const bool is_centre = parameter >= centre && parameter < centre + 3;
    if (parameter >= centre + 3) information(k, k) += 1 / (noise.mm * noise.mm);
    if (is_centre && knowledge == BallCentre::Knowledge::Measured) {
      information(k, k) += 1 / (noise.centre_mm * noise.centre_mm);
    }
  }
  information += slopes.transpose() * slopes;
  // Each parameter is in units of its own sigma, since turns and millimetres would be badly
  // conditioned together.
  const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::MatrixXd bound = scale.asDiagonal() * scaled.inverse() * scale.asDiagonal();
  const double sum = (view * bound * view.transpose()).trace();
  return optics::degrees(std::sqrt(sum / double(pixels.size())));
}

}  // namespace orbwatch::tests
