// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/consensus/refinement.h"

#include <ceres/covariance.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "proc/align/matrix3.h"
#include "proc/align/prior.h"
#include "proc/align/register/consensus/match_difference.h"
#include "proc/align/register/consensus/refinement_trial.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Mat3;

constexpr double kRobustFrom = 1.5;  // sigmas
constexpr double kFits = 4;          // robust sigmas
constexpr double kMeanSigma = 0.2;   // prior sigma of a room's mean closeness
// Rounds for an unstated room's spread and everything that depends on it.
constexpr int kSpreadRounds = 3;
// Distinct places of an unstated room: walls and large things, about.
constexpr double kPlaces = 10;

/// Residual of a match: the difference between both cameras' sights, in sigmas.
class Disagreement final : public ceres::CostFunction {
 public:
  Disagreement(const RefinementTrial& trial, const SightedMatch& match)
      : trial_(trial), match_(match) {
    set_num_residuals(std::tuple_size_v<Difference>);
    *mutable_parameter_block_sizes() = {kTurn, kOutline, kRoom};
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    const auto here = at(trial_.centre());
    if (!here) return false;
    std::ranges::copy(*here, residuals);
    if (!jacobians) return true;
    std::size_t unknown = 0;
    for (std::size_t block = 0; block < parameter_block_sizes().size(); ++block) {
      const auto width = static_cast<std::size_t>(parameter_block_sizes()[block]);
      for (std::size_t column = 0; column < width; ++column, ++unknown) {
        if (!jacobians[block]) continue;
        const Difference slope = slope_of(unknown);
        for (std::size_t row = 0; row < slope.size(); ++row) {
          jacobians[block][row * width + column] = slope[row];
        }
      }
    }
    return true;
  }

 private:
  std::optional<Difference> at(const TrialPlace& place) const {
    return place.ball ? std::optional(difference(match_, place)) : std::nullopt;
  }

  Difference slope_of(std::size_t unknown) const {
    const auto low = at(trial_.beside(unknown, 0)), high = at(trial_.beside(unknown, 1));
    Difference slope{};
    if (!low || !high) return slope;
    for (std::size_t row = 0; row < slope.size(); ++row) {
      slope[row] = ((*high)[row] - (*low)[row]) / (2 * kTrialStep);
    }
    // The direction jumps across an edge of a stated scene and has no slope there.
    constexpr double kSteepest = 1e3;
    const bool jumps = !trial_.centre().room && length(slope) * match_.sigma > kSteepest;
    return jumps ? Difference{} : slope;
  }

  const RefinementTrial& trial_;
  SightedMatch match_;
};

class Problem {
 public:
  Problem(const SoughtCamera& sought, const RefinementState& start)
      : trial_(sought, start), problem_([this] {
          ceres::Problem::Options options;
          options.evaluation_callback = &trial_;
          return options;
        }()) {
    problem_.AddParameterBlock(turn(), kTurn);
    add_block(outline(), kOutline, sought.outline_sigma > 0, sought.outline_sigma);
    add_block(room(), kRoom, start.room.has_value(), kMeanSigma);
  }

  void add(const SightedMatch& match, ceres::LossFunction* loss) {
    problem_.AddResidualBlock(new Disagreement(trial_, match), loss, turn(), outline(), room());
  }

  bool solve() {
    ceres::Solver::Options options;
    options.max_num_iterations = 30;
    options.logging_type = ceres::SILENT;
    options.linear_solver_type = ceres::DENSE_QR;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  /// Covariance of the turn, for matches whose sigma is right.
  std::optional<Mat3> covariance() {
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::DENSE_SVD;
    ceres::Covariance covariance(options);
    const std::vector<const double*> blocks{turn()};
    std::array<double, kTurn * kTurn> c{};
    if (!covariance.Compute(blocks, &problem_)) return std::nullopt;
    if (!covariance.GetCovarianceMatrix(blocks, c.data())) return std::nullopt;
    return Mat3{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}};
  }

  RefinementState state() const { return trial_.state(); }

 private:
  double* turn() { return trial_.unknowns.data(); }
  double* outline() { return turn() + kTurn; }
  double* room() { return outline() + kOutline; }

  /// Adds unknowns that start at 0 and have the prior `sigma`.
  void add_block(double* block, int size, bool is_sought, double sigma) {
    problem_.AddParameterBlock(block, size);
    if (is_sought) {
      const std::vector<double> means(static_cast<std::size_t>(size), 0.0);
      problem_.AddResidualBlock(new Prior(means, sigma), nullptr, block);
    } else {
      problem_.SetParameterBlockConstant(block);
    }
  }

  RefinementTrial trial_;
  ceres::Problem problem_;
};

TrialPlace place_of(const SoughtCamera& sought, const RefinementState& state) {
  const auto ball = turned(sought, state.rotation, state.outline);
  return {ball ? std::optional(*ball) : std::nullopt, state.room};
}

struct Solution {
  RefinementState state;
  Mat3 covariance;
};

Result<Solution> solve(const std::vector<SightedMatch>& matches, const SoughtCamera& sought,
                       const RefinementState& start) {
  const TrialPlace place = place_of(sought, start);
  if (!place.ball) return fail("the rotation to start from has no projection");
  const double scale = std::max(0.2, robust_sigma(errors(matches, place)));
  Problem problem(sought, start);
  // Bounded influence: accidental matches must not pull.
  for (const SightedMatch& one : matches) {
    problem.add(one, new ceres::CauchyLoss(kRobustFrom * scale));
  }
  const auto covariance = problem.solve() ? problem.covariance() : std::nullopt;
  if (!covariance) return fail("the features do not determine the rotation");
  return Solution{problem.state(), *covariance};
}

/// Solves including the spread of the room and the noise of the matches, which determine each
/// other. Matches on one wall deviate from the mean together: the closeness of all matches has only
/// as much information on the rotation as one match per place.
Result<Solution> solve_with_room(std::vector<SightedMatch>& matches, const SoughtCamera& sought,
                                 const RefinementState& start) {
  RefinementState state = start;
  for (int round = 0;; ++round) {
    RefinementState careful = state;
    careful.room->spread *= std::max(1.0, std::sqrt(static_cast<double>(matches.size()) / kPlaces));
    auto solution = solve(matches, sought, careful);
    if (!solution) return solution;
    solution->state.room->spread = state.room->spread;
    if (round == kSpreadRounds) return solution;
    state = solution->state;
    const TrialPlace place = place_of(sought, state);
    if (!place.ball) return fail("the rotation that was found has no projection");
    const RoomEvidence evidence = room_evidence(matches, place);
    state.room = evidence.room;
    for (SightedMatch& match : matches) match.sigma *= evidence.noise;
  }
}

}  // namespace

Result<RotationRefinement> refine_rotation(const std::vector<Match>& matches,
                                           const BallProjection& reference,
                                           const SoughtCamera& sought,
                                           const RefinementState& start) {
  const auto ball = turned(sought, start.rotation, start.outline);
  if (!ball) return tl::unexpected(ball.error());
  std::vector<SightedMatch> all = sighted(matches, reference, *ball);
  if (all.size() < 3) return fail("too few features agree: three are needed at the very least");
  const auto solution =
      start.room ? solve_with_room(all, sought, start) : solve(all, sought, start);
  if (!solution) return tl::unexpected(solution.error());
  const TrialPlace place = place_of(sought, solution->state);
  if (!place.ball) return fail("the rotation that was found has no projection");

  RotationRefinement result{solution->state, {}, 0, 0};
  const std::vector<double> left = errors(all, place);
  const double unit = std::max(0.1, robust_sigma(left));
  double squares = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (!(left[n] < kFits * unit)) continue;
    ++result.inliers;
    const double apart = direction_error(difference(all[n], place)) * all[n].sigma;
    squares += apart * apart;
  }
  if (result.inliers == 0) return fail("no features agree");
  result.residual = optics::degrees(std::sqrt(squares / result.inliers));
  result.covariance = solution->covariance * (unit * unit);
  return result;
}

}  // namespace orbwatch::align
