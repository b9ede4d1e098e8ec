// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/scene/moving_things.h"

namespace orbwatch::app::simulation {

MovingThings::MovingThings(const MachineSettings& settings, double seconds)
    : settings_(settings),
      process_(process_at(settings, seconds)),
      nozzle_(settings.nozzle, process_.nozzle_tip, settings.enclosure.hi.z) {}

Candidates MovingThings::everything() const {
  Candidates all;
  all.nozzle = true;
  all.pool = true;
  for (std::size_t i = 0; i < process_.spark_count; ++i) {
    all.sparks[all.spark_count++] = static_cast<std::uint8_t>(i);
  }
  return all;
}

Candidates MovingThings::meeting(const RayBundle& rays, const Candidates& among) const {
  Candidates result;
  if (among.nozzle) {
    for (const Sphere& part : nozzle_.bounds())
      result.nozzle = result.nozzle || rays.may_meet(part);
  }
  result.pool = among.pool && rays.may_meet({process_.pool.centre, process_.pool.reach});
  for (std::size_t i = 0; i < among.spark_count; ++i) {
    const Spark& spark = process_.spark_slots[among.sparks[i]];
    if (rays.may_meet({spark.position, spark.radius})) {
      result.sparks[result.spark_count++] = among.sparks[i];
    }
  }
  return result;
}

Encounter MovingThings::first_on(const Sight& sight, const SightCandidates& candidates) const {
  const Encounter before = first_on(sight.direct, sight.ball_distance, candidates.direct);
  if (before.kind != Encounter::Kind::None || !sight.on_ball()) return before;
  const Encounter after = first_on(sight.mirrored, kNever, candidates.mirrored);
  const bool hidden = after.kind != Encounter::Kind::None &&
                      obstacle_distance(settings_, sight.direct) < sight.ball_distance;
  return hidden ? Encounter{} : after;
}

Encounter MovingThings::first_on(const Ray& ray, double limit, const Candidates& candidates) const {
  Encounter found;
  double nearest = limit;
  const auto offer = [&](double distance, Encounter::Kind kind, double temperature) {
    if (distance >= nearest) return;
    nearest = distance;
    found.kind = kind;
    found.temperature = temperature;
  };
  for (std::size_t i = 0; i < candidates.spark_count; ++i) {
    const Spark& spark = process_.spark_slots[candidates.sparks[i]];
    offer(entry(ray, Sphere{spark.position, spark.radius}), Encounter::Kind::Spark,
          spark.temperature);
  }
  if (candidates.nozzle) {
    offer(nozzle_.entry(ray), Encounter::Kind::Nozzle, settings_.nozzle.temperature);
  }
  if (candidates.pool) offer(pool_distance(ray), Encounter::Kind::Pool, 0);
  if (found.kind == Encounter::Kind::None) return found;

  const StaticHit rest = nearest_static(settings_, ray);
  found.point = ray.at(nearest);
  if (found.kind == Encounter::Kind::Pool) {
    if (rest.surface != Surface::Workpiece || rest.normal.z <= 0) return {};
    found.temperature = process_.pool.temperature_at(norm(found.point - process_.pool.centre));
    return found;
  }
  return nearest < rest.distance ? found : Encounter{};
}

double MovingThings::pool_distance(const Ray& ray) const {
  const MeltPool& pool = process_.pool;
  const double distance = (pool.centre.z - ray.origin.z) / ray.direction.z;
  if (!(distance > 0)) return kNever;
  const Vec3 from_centre = ray.at(distance) - pool.centre;
  return dot(from_centre, from_centre) < pool.reach * pool.reach ? distance : kNever;
}

}  // namespace orbwatch::app::simulation
