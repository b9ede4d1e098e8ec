// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "app/simulation/machine.h"

namespace orbwatch::app::simulation {

/// Molten pool at one moment, a disc on the workpiece's top. Its temperature over the distance r
/// from the centre is a Gaussian through peak and melting point:
///   T(r) = ambient + (peak - ambient) q^((r / radius)^2),
///   q = (melting_point - ambient) / (peak - ambient), so T(0) = peak, T(radius) = melting_point.
struct MeltPool {
  Vec3 centre;               ///< mm, machine frame
  double radius = 0;         ///< radius of the molten area, mm
  double peak = 0;           ///< degC
  double melting_point = 0;  ///< degC
  double ambient = 0;        ///< degC of the workpiece far from the pool
  double reach = 0;          ///< mm: beyond it T(r) - ambient is below 0.01 K and counts as 0

  /// Temperature, degC, at `distance` mm from the centre, on the workpiece's top.
  double temperature_at(double distance) const;
};

/// Drop in flight.
struct Spark {
  Vec3 position;           ///< centre in the machine frame, mm
  double radius = 0;       ///< mm
  double temperature = 0;  ///< uniform temperature, degC
};

/// Moving parts of the machine at one moment.
struct ProcessTruth {
  MeltPool pool;
  Vec3 nozzle_tip;  ///< mm, above the pool
  std::size_t spark_count = 0;
  std::array<Spark, kMaxSparks> spark_slots;

  std::span<const Spark> sparks() const& { return {spark_slots.data(), spark_count}; }
  void sparks() const&& = delete;  // the span would outlive its sparks
};

/// State of the process `seconds` after the machine's epoch: a pure function of its arguments.
/// Settings are a Machine's, which has checked them. Sparks end on workpiece, table, floor or
/// walls; nozzle and ball do not stop them. No allocation. Reentrant.
ProcessTruth process_at(const MachineSettings& settings, double seconds);

}  // namespace orbwatch::app::simulation
