// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "app/simulation/tracing/ray.h"
#include "hal/clock.h"
#include "proc/image/result.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::simulation {

/// Largest number of sparks in the air at the same time.
inline constexpr std::size_t kMaxSparks = 64;

/// Interval for uniform random values from lo to hi.
struct Interval {
  double lo = 0;
  double hi = 0;
};

/// Molten pool on the workpiece's top: it runs on a circle, its size and heat vary slowly.
struct PoolSettings {
  double path_x = -110;         ///< mm, centre of the circle
  double path_y = -50;          ///< mm
  double path_radius = 40;      ///< mm
  double lap_time = 12;         ///< s for one round, counter-clockwise seen from above
  double radius = 10;           ///< mm, mean molten radius
  double radius_swing = 0.25;   ///< variation as a share of the radius, with a period of 7 s
  double peak = 2000;           ///< degC in the centre, mean
  double peak_swing = 150;      ///< variation of the peak in degC, with a period of 11 s
  double melting_point = 1400;  ///< degC at the edge of the molten area
};

/// Drops of metal that leave the pool and fly ballistically.
struct SparkSettings {
  double rate = 60;                  ///< per second, mean; 0: none
  Interval speed{600, 1800};         ///< mm/s at the start
  Interval lifetime{0.12, 0.35};     ///< s, unless it lands earlier
  Interval radius{2.5, 5};           ///< mm
  Interval temperature{1500, 1900};  ///< degC at the start
  double end_temperature = 1250;     ///< degC at the end of its lifetime, reached linearly
};

/// Processing head above the pool: a cone with its tip down, and a column up to the ceiling.
struct NozzleSettings {
  double standoff = 15;       ///< mm between pool and tip
  double tip_radius = 5;      ///< mm
  double cone_height = 60;    ///< mm
  double column_radius = 25;  ///< mm
  double temperature = 70;    ///< degC
};

/// Laser-cladding machine with a mirror ball. Machine frame: right-handed, X right, Y forward, Z
/// up, mm; the operator is at the front, the side of lower Y.
struct MachineSettings {
  Sphere ball{{120, 60, 430}, 50};  ///< reflects everything, without loss
  Box enclosure{{-600, -500, 0}, {600, 500, 800}};
  Box table{{-250, -200, 100}, {250, 200, 140}};
  Box workpiece{{-190, -130, 140}, {-30, 30, 178}};
  double workpiece_temperature = 90;  ///< degC, far from the pool
  PoolSettings pool;
  SparkSettings sparks;
  NozzleSettings nozzle;
  std::uint64_t seed = 1;  ///< random seed: the same seed gives the same sparks and the same noise
  /// Folder with a file for each connected simulated device, named like the camera or the line;
  /// empty: all are connected.
  std::filesystem::path connected;
};

/// True while a simulated device is connected. Reentrant.
bool is_connected(const MachineSettings& machine, const std::string& device);

/// Visits the keys in a site's file.
template <class Visitor>
void visit(Visitor& v, MachineSettings& machine) {
  v.optional("seed", machine.seed, Range::between(0, 2147483647),
             "Random seed for sparks and noise");
  v.optional("spark_rate", machine.sparks.rate, Range::between(0, 150),
             "Mean number of sparks per second");
  v.optional("pool_radius", machine.pool.radius, Range::between(1, 20),
             "Mean radius of the molten pool, mm");
  v.optional("pool_temperature", machine.pool.peak, Range::between(1500, 2300),
             "Mean temperature in the pool's centre, degC");
  v.optional("connected", machine.connected,
             "Folder with one file for each connected simulated camera (its name) and line (its "
             "line_name); removing a file simulates unplugging. Without the key all are connected");
}

/// One machine and its clock, shared by all cameras that look into it. Immutable, reentrant.
class Machine {
 public:
  /// Makes the machine whose process time is 0 at `epoch`. Errors: a body outside the enclosure or
  /// in another, a value out of range, too many sparks.
  static Result<std::shared_ptr<const Machine>> make(const MachineSettings& settings,
                                                     hal::TimePoint epoch);

  const MachineSettings& settings() const { return settings_; }

  /// Moment on the process' own clock, s: the argument of process_at().
  double process_time(hal::TimePoint moment) const {
    return std::chrono::duration<double>(moment - epoch_).count();
  }

 private:
  Machine(const MachineSettings& settings, hal::TimePoint epoch)
      : settings_(settings), epoch_(epoch) {}

  MachineSettings settings_;
  hal::TimePoint epoch_;
};

}  // namespace orbwatch::app::simulation
