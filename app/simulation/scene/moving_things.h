// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/simulation/scene/nozzle.h"
#include "app/simulation/scene/process.h"
#include "app/simulation/scene/static_scene.h"
#include "app/simulation/tracing/ray_bundle.h"

namespace orbwatch::app::simulation {

/// Moving objects that some rays may hit; the rays miss all others.
struct Candidates {
  bool nozzle = false;
  bool pool = false;
  std::size_t spark_count = 0;
  std::array<std::uint8_t, kMaxSparks> sparks{};  ///< indices into the process' sparks

  bool empty() const { return !nozzle && !pool && spark_count == 0; }
};

/// Candidates for both parts of a line of sight.
struct SightCandidates {
  Candidates direct;
  Candidates mirrored;

  bool empty() const { return direct.empty() && mirrored.empty(); }
};

/// Moving object at the end of a line of sight.
struct Encounter {
  enum class Kind : std::uint8_t { None, Nozzle, Spark, Pool };
  Kind kind = Kind::None;
  double temperature = 0;  ///< degC
  Vec3 point;              ///< mm, machine frame
};

/// Moving objects at one moment, for intersection with rays: nozzle and sparks are solid, the pool
/// is heat on the workpiece's top. No allocation. Reentrant.
class MovingThings {
 public:
  /// `settings` must outlive this object.
  MovingThings(const MachineSettings& settings, double seconds);

  Candidates everything() const;
  /// Objects `among` the candidates that rays of the bundle may hit.
  Candidates meeting(const RayBundle& rays, const Candidates& among) const;

  /// Moving object that is visible along `sight`: nearer than all other objects, moving or static.
  Encounter first_on(const Sight& sight, const SightCandidates& candidates) const;

  const Nozzle& nozzle() const { return nozzle_; }

 private:
  Encounter first_on(const Ray& ray, double limit, const Candidates& candidates) const;
  double pool_distance(const Ray& ray) const;

  const MachineSettings& settings_;
  ProcessTruth process_;
  Nozzle nozzle_;
};

}  // namespace orbwatch::app::simulation
