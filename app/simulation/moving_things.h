#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/simulation/nozzle.h"
#include "app/simulation/process.h"
#include "app/simulation/ray_bundle.h"
#include "app/simulation/static_scene.h"

namespace orbwatch::app::simulation {

/// Which moving things some rays may meet; the rest they surely miss.
struct Candidates {
  bool nozzle = false;
  bool pool = false;
  std::size_t spark_count = 0;
  std::array<std::uint8_t, kMaxSparks> sparks{};  ///< indices into the process' sparks

  bool empty() const { return !nozzle && !pool && spark_count == 0; }
};

/// Candidates for both parts of a sight.
struct SightCandidates {
  Candidates direct;
  Candidates mirrored;

  bool empty() const { return direct.empty() && mirrored.empty(); }
};

/// What a sight ends on, if that is not at rest.
struct Encounter {
  enum class Kind : std::uint8_t { None, Nozzle, Spark, Pool };
  Kind kind = Kind::None;
  double temperature = 0;  ///< degC
  Vec3 point;              ///< mm, machine frame
};

/// All that moves, at one moment, ready for rays to meet it: nozzle and sparks are solid, the pool
/// is heat on the workpiece's top. No allocation. Reentrant.
class MovingThings {
 public:
  /// `settings` must outlive this object.
  MovingThings(const MachineSettings& settings, double seconds);

  Candidates everything() const;
  /// Those `among` the candidates that rays of the bundle may meet.
  Candidates meeting(const RayBundle& rays, const Candidates& among) const;

  /// The moving thing that is seen along `sight`: nearer than all other things, moving or at rest.
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
