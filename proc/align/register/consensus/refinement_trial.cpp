// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/consensus/refinement_trial.h"

#include "proc/align/register/place_change.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::align {

RefinementTrial::RefinementTrial(const SoughtCamera& sought, const RefinementState& start)
    : sought_(sought), start_(start) {
  if (start.room) unknowns.back() = start.room->mean;
}

void RefinementTrial::PrepareForEvaluation(bool wants_derivatives, bool is_new_point) {
  if (is_new_point) centre_ = at(unknowns);
  if (!wants_derivatives) return;
  for (std::size_t n = 0; n < kUnknowns; ++n) {
    for (const int side : {0, 1}) {
      Unknowns stepped = unknowns;
      stepped[n] += side == 0 ? -kTrialStep : kTrialStep;
      beside_[n][static_cast<std::size_t>(side)] = at(stepped);
    }
  }
}

RefinementState RefinementTrial::state() const { return state(unknowns); }

RefinementState RefinementTrial::state(const Unknowns& x) const {
  RefinementState moved = start_;
  moved.rotation = rotation_about({x[0], x[1], x[2]}) * start_.rotation;
  moved.outline = changed(start_.outline, x[3], x[4], x[5]);
  if (moved.room) moved.room->mean = x[6];
  return moved;
}

TrialPlace RefinementTrial::at(const Unknowns& x) const {
  const RefinementState moved = state(x);
  const auto ball = turned(sought_, moved.rotation, moved.outline);
  return {ball ? std::optional(*ball) : std::nullopt, moved.room};
}

}  // namespace orbwatch::align
