// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/machine.h"

#include <cmath>
#include <string>

namespace orbwatch::app::simulation {
namespace {

tl::unexpected<Error> refuse(const std::string& what) { return fail("simulated machine: " + what); }

bool valid(const Box& box) {
  return box.lo.x < box.hi.x && box.lo.y < box.hi.y && box.lo.z < box.hi.z;
}

bool inside(const Box& inner, const Box& outer) {
  return outer.contains(inner.lo) && outer.contains(inner.hi);
}

bool touches(const Sphere& ball, const Box& box) {
  const Vec3 nearest{std::clamp(ball.centre.x, box.lo.x, box.hi.x),
                     std::clamp(ball.centre.y, box.lo.y, box.hi.y),
                     std::clamp(ball.centre.z, box.lo.z, box.hi.z)};
  return norm(ball.centre - nearest) <= ball.radius;
}

bool valid(const Interval& range) { return range.lo > 0 && range.lo <= range.hi; }

Result<> check_bodies(const MachineSettings& s) {
  const double r = s.ball.radius;
  const Box around_ball{s.ball.centre - Vec3{r, r, r}, s.ball.centre + Vec3{r, r, r}};
  if (!valid(s.enclosure)) return refuse("the enclosure's lo must be below its hi");
  if (!valid(s.table) || !inside(s.table, s.enclosure)) {
    return refuse("the table must be a box inside the enclosure");
  }
  if (!valid(s.workpiece) || !inside(s.workpiece, s.enclosure)) {
    return refuse("the workpiece must be a box inside the enclosure");
  }
  if (!(r > 0) || !inside(around_ball, s.enclosure)) {
    return refuse("the ball needs a radius above 0 and must hang inside the enclosure");
  }
  if (touches(s.ball, s.table) || touches(s.ball, s.workpiece)) {
    return refuse("the ball must be clear of table and workpiece");
  }
  return {};
}

Result<> check_pool(const MachineSettings& s) {
  const PoolSettings& pool = s.pool;
  const double reach = std::abs(pool.path_radius);
  const Box path{{pool.path_x - reach, pool.path_y - reach, s.workpiece.hi.z},
                 {pool.path_x + reach, pool.path_y + reach, s.workpiece.hi.z}};
  if (!inside(path, s.workpiece)) return refuse("the pool's path must stay on the workpiece");
  if (!(pool.lap_time > 0) || !(pool.radius > 0)) {
    return refuse("the pool's lap time and radius must be above 0");
  }
  if (!(pool.radius_swing >= 0 && pool.radius_swing < 1)) {
    return refuse("the pool's radius swing must be from 0 to below 1");
  }
  // Closer to the melting point the profile, fixed by its molten radius, would become unbounded.
  constexpr double kLeastSuperheat = 50;
  if (!(pool.peak - std::abs(pool.peak_swing) >= pool.melting_point + kLeastSuperheat) ||
      !(pool.melting_point > s.workpiece_temperature)) {
    return refuse(
        "the pool's peak must stay 50 degC above its melting point, that above the "
        "workpiece");
  }
  return {};
}

Result<> check_sparks(const SparkSettings& sparks) {
  if (!valid(sparks.speed) || !valid(sparks.lifetime) || !valid(sparks.radius) ||
      !valid(sparks.temperature)) {
    return refuse("the sparks' ranges must be above 0 and in rising order");
  }
  // One spark starts in each interval of 1 / rate; a lifetime overlaps up to two more of them.
  if (!(sparks.rate >= 0) ||
      !(sparks.rate * sparks.lifetime.hi + 2 <= static_cast<double>(kMaxSparks))) {
    return refuse("the sparks' rate times their lifetime must be from 0 to " +
                  std::to_string(kMaxSparks - 2));
  }
  return {};
}

Result<> check_nozzle(const MachineSettings& s) {
  const NozzleSettings& nozzle = s.nozzle;
  if (!(nozzle.standoff > 0 && nozzle.tip_radius > 0 && nozzle.cone_height > 0 &&
        nozzle.column_radius >= nozzle.tip_radius)) {
    return refuse("the nozzle's lengths must be above 0 and its column no thinner than its tip");
  }
  if (!(s.workpiece.hi.z + nozzle.standoff + nozzle.cone_height < s.enclosure.hi.z)) {
    return refuse("the nozzle must be below the ceiling");
  }
  const double distance =
      std::hypot(s.ball.centre.x - s.pool.path_x, s.ball.centre.y - s.pool.path_y);
  if (distance <= std::abs(s.pool.path_radius) + nozzle.column_radius + s.ball.radius) {
    return refuse("the nozzle must be clear of the ball on its whole path");
  }
  return {};
}

}  // namespace

bool is_connected(const MachineSettings& machine, const std::string& device) {
  std::error_code inaccessible;
  return machine.connected.empty() ||
         std::filesystem::exists(machine.connected / device, inaccessible);
}

Result<std::shared_ptr<const Machine>> Machine::make(const MachineSettings& settings,
                                                     hal::TimePoint epoch) {
  auto checked = check_bodies(settings)
                     .and_then([&] { return check_pool(settings); })
                     .and_then([&] { return check_sparks(settings.sparks); })
                     .and_then([&] { return check_nozzle(settings); });
  if (!checked) return tl::unexpected(checked.error());
  return std::shared_ptr<const Machine>(new Machine(settings, epoch));
}

}  // namespace orbwatch::app::simulation
