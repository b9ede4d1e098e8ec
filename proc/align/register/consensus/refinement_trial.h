// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/evaluation_callback.h>

#include <array>
#include <cstddef>
#include <optional>

#include "proc/align/register/light/line_of_sight.h"
#include "proc/align/register/registration.h"

namespace orbwatch::align {

inline constexpr int kTurn = 3;     ///< a small turn about the reference frame's axes, radians
inline constexpr int kOutline = 3;  ///< centre and radius, shares of the radius
inline constexpr int kRoom = 1;     ///< the room's mean closeness
inline constexpr int kUnknowns = kTurn + kOutline + kRoom;
inline constexpr double kTrialStep = 1e-5;  ///< step to either side of every unknown

/// The start of a refinement, or its current state.
struct RefinementState {
  optics::Mat3 rotation;
  optics::Outline outline;
  std::optional<RoomCloseness> room;  ///< set where no scene is stated
};

/// The sought camera for given values of the unknowns.
struct TrialPlace {
  std::optional<optics::BallProjection> ball;  ///< nullopt: the values make no projection
  std::optional<RoomCloseness> room;
};

/// The sought camera at a trial, and a step to either side of every unknown: computed once for all
/// matches.
class RefinementTrial final : public ceres::EvaluationCallback {
 public:
  /// `sought` outlives it.
  RefinementTrial(const SoughtCamera& sought, const RefinementState& start);

  void PrepareForEvaluation(bool wants_derivatives, bool is_new_point) override;

  RefinementState state() const;
  const TrialPlace& centre() const { return centre_; }
  const TrialPlace& beside(std::size_t unknown, std::size_t side) const {
    return beside_[unknown][side];
  }

  using Unknowns = std::array<double, kUnknowns>;
  Unknowns unknowns{};

 private:
  RefinementState state(const Unknowns& x) const;
  TrialPlace at(const Unknowns& x) const;

  const SoughtCamera& sought_;
  RefinementState start_;
  TrialPlace centre_;
  std::array<std::array<TrialPlace, 2>, kUnknowns> beside_;
};

}  // namespace orbwatch::align
