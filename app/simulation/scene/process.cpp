// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/scene/process.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "app/simulation/scene/hash.h"

namespace orbwatch::app::simulation {
namespace {

constexpr double kGravity = 9810;  // mm/s^2
constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRadiusPeriod = 7;    // s
constexpr double kPeakPeriod = 11;     // s
constexpr double kNegligible = 0.01;   // K
constexpr double kLeastUpward = 0.42;  // cosine of the widest angle between spark and vertical

MeltPool pool_at(const MachineSettings& settings, double seconds) {
  const PoolSettings& s = settings.pool;
  const double angle = kTurn * seconds / s.lap_time;
  MeltPool pool;
  pool.centre = {s.path_x + s.path_radius * std::cos(angle),
                 s.path_y + s.path_radius * std::sin(angle), settings.workpiece.hi.z};
  pool.radius = s.radius * (1 + s.radius_swing * std::sin(kTurn * seconds / kRadiusPeriod));
  pool.peak = s.peak + s.peak_swing * std::sin(kTurn * seconds / kPeakPeriod);
  pool.melting_point = s.melting_point;
  pool.ambient = settings.workpiece_temperature;
  const double excess = pool.peak - pool.ambient;
  pool.reach = pool.radius * std::sqrt(std::log(excess / kNegligible) /
                                       std::log(excess / (pool.melting_point - pool.ambient)));
  return pool;
}

/// Start of one spark's flight; all its properties follow from its number.
struct Launch {
  double moment = 0;  // s
  Vec3 position;
  Vec3 velocity;  // mm/s

  Vec3 after(double age) const {
    return position + velocity * age - Vec3{0, 0, 0.5 * kGravity * age * age};
  }
};

/// Random properties of a spark, each from a channel of its own.
enum Channel : std::uint64_t { Birth, Upward, Azimuth, Speed, Lifetime, Radius, Temperature };

double draw(const MachineSettings& settings, std::int64_t number, Channel channel, Interval range) {
  const double share = uniform(settings.seed, static_cast<std::uint64_t>(number), channel);
  return range.lo + share * (range.hi - range.lo);
}

Launch launch(const MachineSettings& settings, std::int64_t number) {
  const double share = draw(settings, number, Birth, {0, 1});
  const double moment = (static_cast<double>(number) + share) / settings.sparks.rate;
  const double up = draw(settings, number, Upward, {kLeastUpward, 1});
  const double level = std::sqrt(1 - up * up);
  const double azimuth = draw(settings, number, Azimuth, {0, kTurn});
  const double speed = draw(settings, number, Speed, settings.sparks.speed);
  return {moment, pool_at(settings, moment).centre,
          Vec3{level * std::cos(azimuth), level * std::sin(azimuth), up} * speed};
}

/// Age at which the flight falls to `height`, which is not above its start.
double fall_to(const Launch& flight, double height) {
  const double v = flight.velocity.z;
  return (v + std::sqrt(v * v + 2 * kGravity * (flight.position.z - height))) / kGravity;
}

/// Age at which the flight rises to `height` above its start; kNever when it stays below.
double rise_to(const Launch& flight, double height) {
  const double v = flight.velocity.z;
  const double discriminant = v * v - 2 * kGravity * (height - flight.position.z);
  return discriminant > 0 ? (v - std::sqrt(discriminant)) / kGravity : kNever;
}

double landing_on(const Launch& flight, const Box& body) {
  if (body.hi.z > flight.position.z) return kNever;
  const double age = fall_to(flight, body.hi.z);
  const Vec3 p = flight.after(age);
  const bool above = p.x >= body.lo.x && p.x <= body.hi.x && p.y >= body.lo.y && p.y <= body.hi.y;
  return above ? age : kNever;
}

double reach_of_wall(double start, double velocity, double lo, double hi) {
  return ((velocity > 0 ? hi : lo) - start) / velocity;
}

double end_of_flight(const MachineSettings& settings, const Launch& flight) {
  const Box& walls = settings.enclosure;
  return std::min({landing_on(flight, settings.workpiece), landing_on(flight, settings.table),
                   fall_to(flight, walls.lo.z), rise_to(flight, walls.hi.z),
                   reach_of_wall(flight.position.x, flight.velocity.x, walls.lo.x, walls.hi.x),
                   reach_of_wall(flight.position.y, flight.velocity.y, walls.lo.y, walls.hi.y)});
}

std::optional<Spark> spark_at(const MachineSettings& settings, std::int64_t number,
                              double seconds) {
  const Launch flight = launch(settings, number);
  const double age = seconds - flight.moment;
  const double lifetime = draw(settings, number, Lifetime, settings.sparks.lifetime);
  if (age < 0 || age >= std::min(lifetime, end_of_flight(settings, flight))) return std::nullopt;
  const double start = draw(settings, number, Temperature, settings.sparks.temperature);
  const double cooled = (start - settings.sparks.end_temperature) * age / lifetime;
  return Spark{flight.after(age), draw(settings, number, Radius, settings.sparks.radius),
               start - cooled};
}

}  // namespace

double MeltPool::temperature_at(double distance) const {
  if (distance >= reach) return ambient;
  const double ratio = distance / radius;
  const double excess = peak - ambient;
  return ambient + excess * std::pow((melting_point - ambient) / excess, ratio * ratio);
}

ProcessTruth process_at(const MachineSettings& settings, double seconds) {
  ProcessTruth truth;
  truth.pool = pool_at(settings, seconds);
  truth.nozzle_tip = truth.pool.centre + Vec3{0, 0, settings.nozzle.standoff};
  const double rate = settings.sparks.rate;
  if (rate <= 0) return truth;
  const auto newest = static_cast<std::int64_t>(std::floor(seconds * rate));
  const auto oldest =
      static_cast<std::int64_t>(std::floor((seconds - settings.sparks.lifetime.hi) * rate));
  for (std::int64_t number = oldest; number <= newest; ++number) {
    if (const auto spark = spark_at(settings, number, seconds)) {
      truth.spark_slots[truth.spark_count++] = *spark;
    }
  }
  return truth;
}

}  // namespace orbwatch::app::simulation
