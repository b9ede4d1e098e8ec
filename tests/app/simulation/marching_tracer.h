// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/simulation/scene/process.h"

namespace orbwatch::app::simulation {

/// End of a sight, found by a method other than the product's: it walks along the ray in steps
/// shorter than the distance of any body (sphere tracing of distance bounds), and at the ball it
/// turns by reflection. Slow, and without intersection formulas.
class MarchingTracer {
 public:
  enum class Body : std::uint8_t { Wall, Table, Workpiece, Ball, Nozzle, Spark };
  struct End {
    Body body = Body::Wall;
    Vec3 point;
    bool mirrored = false;
    std::size_t spark = 0;
  };

  MarchingTracer(const MachineSettings& settings, double seconds)
      : settings_(settings), process_(process_at(settings, seconds)) {}

  End trace(Vec3 point, Vec3 direction) const {
    End end;
    for (int step = 0; step < 20000; ++step) {
      const auto [distance, body, spark] = nearest(point);
      end.body = body;
      end.spark = spark;
      end.point = point;
      if (distance > kArrived) {
        point = point + direction * distance;
      } else if (body == Body::Ball) {
        const Vec3 normal = normalized(point - settings_.ball.centre);
        const double inward = dot(direction, normal);
        if (inward < 0) direction = direction - normal * (2 * inward);
        end.mirrored = true;
        point = point + direction * (4 * kArrived);
      } else {
        break;
      }
    }
    return end;
  }

  /// Temperature, degC, at the end of a trace; walls and table are not modelled here and count as
  /// 0.
  double temperature(const End& end) const {
    constexpr double kOnTop = 1e-6;
    switch (end.body) {
      case Body::Spark:
        return process_.sparks()[end.spark].temperature;
      case Body::Nozzle:
        return settings_.nozzle.temperature;
      case Body::Workpiece:
        return settings_.workpiece.hi.z - end.point.z > kOnTop
                   ? settings_.workpiece_temperature
                   : process_.pool.temperature_at(norm(end.point - process_.pool.centre));
      default:
        return 0;
    }
  }

  const ProcessTruth& process() const { return process_; }

 private:
  static constexpr double kArrived = 1e-8;  // mm
  struct Nearest {
    double distance;
    Body body;
    std::size_t spark;
  };

  static double outside(const Box& box, const Vec3& p) {
    const Vec3 q{std::max({box.lo.x - p.x, p.x - box.hi.x, 0.0}),
                 std::max({box.lo.y - p.y, p.y - box.hi.y, 0.0}),
                 std::max({box.lo.z - p.z, p.z - box.hi.z, 0.0})};
    return norm(q);
  }

  static double inside(const Box& box, const Vec3& p) {
    return std::min({p.x - box.lo.x, box.hi.x - p.x, p.y - box.lo.y, box.hi.y - p.y, p.z - box.lo.z,
                     box.hi.z - p.z});
  }

  double to_nozzle(const Vec3& p) const {
    const NozzleSettings& shape = settings_.nozzle;
    const Vec3 q = p - process_.nozzle_tip;
    const double radial = std::hypot(q.x, q.y);
    const double slope = (shape.column_radius - shape.tip_radius) / shape.cone_height;
    const double mantle = (radial - shape.tip_radius - slope * q.z) / std::sqrt(1 + slope * slope);
    const double cone = std::max({mantle, -q.z, q.z - shape.cone_height});
    const double column = std::max(radial - shape.column_radius, shape.cone_height - q.z);
    return std::min(cone, column);
  }

  Nearest nearest(const Vec3& p) const {
    Nearest found{inside(settings_.enclosure, p), Body::Wall, 0};
    const auto offer = [&](double distance, Body body, std::size_t spark) {
      if (distance < found.distance) found = {distance, body, spark};
    };
    offer(outside(settings_.table, p), Body::Table, 0);
    offer(outside(settings_.workpiece, p), Body::Workpiece, 0);
    offer(norm(p - settings_.ball.centre) - settings_.ball.radius, Body::Ball, 0);
    offer(to_nozzle(p), Body::Nozzle, 0);
    for (std::size_t i = 0; i < process_.spark_count; ++i) {
      const Spark& spark = process_.sparks()[i];
      offer(norm(p - spark.position) - spark.radius, Body::Spark, i);
    }
    return found;
  }

  MachineSettings settings_;
  ProcessTruth process_;
};

}  // namespace orbwatch::app::simulation
