// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/scene/static_scene.h"

#include <array>

namespace orbwatch::app::simulation {
namespace {

double component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Vec3 normal_against(const Vec3& direction, int axis) {
  const double sign = component(direction, axis) > 0 ? -1 : 1;
  return {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
}

Surface wall(const Vec3& direction, int axis) {
  constexpr std::array kLow{Surface::Left, Surface::Front, Surface::Floor};
  constexpr std::array kHigh{Surface::Right, Surface::Back, Surface::Ceiling};
  return (component(direction, axis) > 0 ? kHigh : kLow)[static_cast<std::size_t>(axis)];
}

}  // namespace

StaticHit nearest_static(const MachineSettings& settings, const Ray& ray) {
  FaceHit face = exit(ray, settings.enclosure);
  Surface surface = face.distance < kNever ? wall(ray.direction, face.axis) : Surface::Outside;
  const auto offer = [&](const Box& body, Surface its_surface) {
    const FaceHit hit = entry(ray, body);
    if (hit.distance >= face.distance) return;
    face = hit;
    surface = its_surface;
  };
  offer(settings.table, Surface::Table);
  offer(settings.workpiece, Surface::Workpiece);
  return {face.distance, surface, normal_against(ray.direction, face.axis)};
}

double obstacle_distance(const MachineSettings& settings, const Ray& ray) {
  return std::min(entry(ray, settings.table).distance, entry(ray, settings.workpiece).distance);
}

StaticEnd static_end(const MachineSettings& settings, const Sight& sight) {
  const bool mirrored =
      sight.on_ball() && sight.ball_distance <= obstacle_distance(settings, sight.direct);
  const Ray& ray = mirrored ? sight.mirrored : sight.direct;
  return {ray, nearest_static(settings, ray)};
}

}  // namespace orbwatch::app::simulation
