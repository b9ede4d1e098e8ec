// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/scene/appearance.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "app/simulation/scene/hash.h"
#include "app/simulation/scene/lettering.h"

namespace orbwatch::app::simulation {
namespace {

constexpr double kPlate = 100;        // mm
constexpr double kJoint = 5;          // mm
constexpr double kLetterHeight = 90;  // mm
constexpr double kNameHeight = 0.36;  // height of the name above the middle, as a share of the wall
constexpr Appearance kOutside{{0.005, 0.005, 0.005}, 20};

/// Wall seen from the front; `right` and `up` in the machine frame.
struct Wall {
  std::string_view name;
  Vec3 right;
  Vec3 up;
  Light albedo;
  double temperature;  // degC
};

// Walls in the order of Surface.
constexpr std::array kWalls{
    Wall{"LEFT", {0, 1, 0}, {0, 0, 1}, {0.62, 0.26, 0.22}, 22},
    Wall{"RIGHT", {0, -1, 0}, {0, 0, 1}, {0.22, 0.50, 0.26}, 25},
    Wall{"FRONT", {-1, 0, 0}, {0, 0, 1}, {0.62, 0.52, 0.20}, 20},
    Wall{"BACK", {1, 0, 0}, {0, 0, 1}, {0.24, 0.38, 0.62}, 27},
    Wall{"FLOOR", {1, 0, 0}, {0, 1, 0}, {0.26, 0.26, 0.28}, 29},
    Wall{"TOP", {1, 0, 0}, {0, -1, 0}, {0.34, 0.34, 0.33}, 32},
};

/// Light from all sides, and from a lamp in the ceiling's middle.
double illumination(const MachineSettings& settings, const Vec3& point, const Vec3& normal) {
  constexpr double kAmbient = 0.30;
  constexpr double kLamp = 0.55;
  const Box& box = settings.enclosure;
  const Vec3 lamp{(box.lo.x + box.hi.x) / 2, (box.lo.y + box.hi.y) / 2, box.hi.z};
  const Vec3 to_lamp = lamp - point;
  const double distance = norm(to_lamp);
  if (distance <= 0) return kAmbient;
  const double cosine = std::max(0.0, dot(normal, to_lamp) / distance);
  const double reference = box.hi.z - box.lo.z;
  const double falloff = reference * reference / (reference * reference + distance * distance);
  return kAmbient + 2 * kLamp * cosine * falloff;
}

/// True if `along` lies within half of `width` of a multiple of `spacing`.
bool near_multiple(double along, double spacing, double width) {
  return std::abs(along - spacing * std::round(along / spacing)) < width / 2;
}

/// Shade from 0 to 1, one number for each plate of each wall.
double plate_shade(Surface surface, double right, double up) {
  const auto column = static_cast<std::int64_t>(std::floor(right / kPlate));
  const auto row = static_cast<std::int64_t>(std::floor(up / kPlate));
  return uniform(static_cast<std::uint64_t>(surface), static_cast<std::uint64_t>(column),
                 static_cast<std::uint64_t>(row));
}

bool on_lamp(Surface surface, double right, double up) {
  return surface == Surface::Ceiling && std::abs(right) < 160 && std::abs(up) < 40;
}

Appearance wall_look(const MachineSettings& settings, const Vec3& point, const StaticHit& hit) {
  constexpr Appearance kLamp{{1, 1, 0.95}, 48};
  const Wall& wall = kWalls[static_cast<std::size_t>(hit.surface)];
  const Box& box = settings.enclosure;
  const Vec3 from_middle = point - (box.lo + box.hi) * 0.5;
  const double right = dot(from_middle, wall.right);
  const double up = dot(from_middle, wall.up);
  if (on_lamp(hit.surface, right, up)) return kLamp;

  const double lit = illumination(settings, point, hit.normal);
  const double name_up = kNameHeight * std::abs(dot(box.hi - box.lo, wall.up));
  if (on_ink(wall.name, kLetterHeight, right, up - name_up)) {
    return {Light{0.9, 0.9, 0.9} * lit, wall.temperature + 4};
  }
  if (near_multiple(right, kPlate, kJoint) || near_multiple(up, kPlate, kJoint)) {
    return {Light{0.04, 0.04, 0.05} * lit, wall.temperature - 2};
  }
  const double shade = plate_shade(hit.surface, right, up);
  return {wall.albedo * (lit * (0.7 + 0.6 * shade)), wall.temperature + 2 * (shade - 0.5)};
}

Appearance table_look(const MachineSettings& settings, const Vec3& point, const StaticHit& hit) {
  constexpr double kSlotSpacing = 50;  // mm
  constexpr double kSlotWidth = 10;    // mm
  constexpr double kTemperature = 40;  // degC
  const double lit = illumination(settings, point, hit.normal);
  const double from_middle = point.y - (settings.table.lo.y + settings.table.hi.y) / 2;
  const bool slot = hit.normal.z > 0 && near_multiple(from_middle, kSlotSpacing, kSlotWidth);
  return slot ? Appearance{Light{0.05, 0.05, 0.05} * lit, kTemperature - 3}
              : Appearance{Light{0.42, 0.43, 0.45} * lit, kTemperature};
}

Appearance workpiece_look(const MachineSettings& settings, const Vec3& point,
                          const StaticHit& hit) {
  const double lit = illumination(settings, point, hit.normal);
  return {Light{0.30, 0.27, 0.24} * lit, settings.workpiece_temperature};
}

}  // namespace

Appearance appearance_of(const MachineSettings& settings, const Ray& ray, const StaticHit& hit) {
  switch (hit.surface) {
    case Surface::Outside:
      return kOutside;
    case Surface::Table:
      return table_look(settings, ray.at(hit.distance), hit);
    case Surface::Workpiece:
      return workpiece_look(settings, ray.at(hit.distance), hit);
    default:
      return wall_look(settings, ray.at(hit.distance), hit);
  }
}

Light nozzle_light(const MachineSettings& settings, const Vec3& point, const Vec3& normal,
                   bool cone) {
  const Light albedo = cone ? Light{0.60, 0.32, 0.16} : Light{0.34, 0.35, 0.38};
  // Light from the side: without it the head, straight below the lamp, would look flat.
  constexpr Vec3 kSide{0.6, -0.8, 0};
  const double side = std::max(0.0, dot(normal, kSide));
  return albedo * (illumination(settings, point, normal) + 0.4 * side);
}

}  // namespace orbwatch::app::simulation
