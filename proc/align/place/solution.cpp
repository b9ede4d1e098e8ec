// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/solution.h"

#include <algorithm>
#include <cmath>

#include "proc/align/place/contradictions.h"
#include "proc/align/place/request_check.h"
#include "proc/align/place/starts.h"
#include "proc/align/place/uncertainty.h"

namespace orbwatch::align {
namespace {

std::vector<UsedMark> all_marks(const PlaceRequest& request) {
  std::vector<UsedMark> all;
  for (std::size_t c = 0; c < request.cameras.size(); ++c) {
    for (std::size_t m = 0; m < request.cameras[c].marks.size(); ++m) all.push_back({c, m});
  }
  return all;
}

/// The root of the sum of variances of `size` unknowns from a column on.
double joint_sigma(const cv::Mat1d& covariance, int column, int size) {
  double variance = 0;
  for (int k = column; k < column + size; ++k) variance += covariance(k, k);
  return std::sqrt(variance);
}

/// Refuses a solution that would pass only because nothing contradicts it.
Result<> check_determined(const PlaceRequest& request, const Solution& solution) {
  constexpr double kMostTurn = 5;      // degrees
  constexpr double kMostFocal = 0.05;  // share of the focal length
  const auto sigma = [&](int column, int size) {
    return joint_sigma(solution.covariance, column, size);
  };
  for (std::size_t c = 0; c < request.cameras.size(); ++c) {
    const int first = int(c) * kCameraUnknowns;
    const std::string name = "camera " + request.cameras[c].name + ": ";
    if (const double focal = sigma(first + 6, 1); focal > kMostFocal) {
      return fail(name + "the marks do not determine the focal length: it would be known to " +
                  short_number(100 * focal) +
                  " %; calibrate the camera, or mark more points at different distances");
    }
    if (const double turn = optics::degrees(sigma(first, 3)); turn > kMostTurn) {
      return fail(name + "the marks do not determine the rotation: it would be known to " +
                  short_number(turn) + " deg; mark points in other directions");
    }
  }
  const int centre = int(request.cameras.size()) * kCameraUnknowns;
  if (const double off = sigma(centre, 3); off > 1) {
    return fail("the marks do not determine the ball's centre: it would be known to " +
                short_number(off * request.ball_radius) +
                " mm; measure it, or mark more points, near ones too");
  }
  return {};
}

Result<Solution> judged(const PlaceRequest& request, const std::vector<UsedMark>& used,
                        const PlaceState& state) {
  auto equations = Adjustment(request, used).equations(state);
  if (!equations) return fail("the marked points fit no pose");
  auto known = covariance(*equations);
  if (!known) {
    return fail(
        "the marked points do not determine the pose: they lie in one spot or one line as the ball "
        "sees them; mark others, in other directions");
  }
  return Solution{state, std::move(*equations), std::move(*known), used};
}

/// True if two solutions differ by more than their uncertainty.
bool is_another(const Solution& a, const PlaceState& b) {
  constexpr double kLeast = 1e-3;  // rad, radii
  const auto limit = [&](int column) {
    return std::max(kLeast, 6 * joint_sigma(a.covariance, column, 3));
  };
  for (std::size_t c = 0; c < b.cameras.size(); ++c) {
    const optics::Mat3 turn = a.state.cameras[c].rotation * transposed(b.cameras[c].rotation);
    const double cosine = (turn.row0.x + turn.row1.y + turn.row2.z - 1) / 2;
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    if (angle > limit(int(c) * kCameraUnknowns)) return true;
  }
  return norm(a.state.centre - b.centre) > limit(int(b.cameras.size()) * kCameraUnknowns);
}

/// The best solution from all starts; refused if another one fits about as well.
Result<PlaceState> best_state(const PlaceRequest& request, const std::vector<UsedMark>& used) {
  struct Candidate {
    double badness;
    PlaceState state;
  };
  const Adjustment adjustment(request, used);
  std::vector<Candidate> candidates;
  for (const PlaceState& start : starts(request)) {
    const auto robust = adjustment.solve(start, true);
    const auto state = robust ? adjustment.solve(*robust, false) : std::nullopt;
    const auto equations = state ? adjustment.equations(*state) : std::nullopt;
    if (equations) candidates.push_back({equations->sum_of_squares(), *state});
  }
  if (candidates.empty()) {
    return fail("no pose shows the marked points where they are marked");
  }
  std::ranges::sort(candidates, {}, &Candidate::badness);
  const auto best = judged(request, used, candidates.front().state);
  if (!best) return tl::unexpected(best.error());
  constexpr double kAsGood = 12;  // difference of chi-square
  for (const Candidate& other : candidates) {
    if (other.badness < candidates.front().badness + kAsGood && is_another(*best, other.state)) {
      return fail("the marked points fit two different poses; mark one more");
    }
  }
  return candidates.front().state;
}

std::string off_text(const PlaceRequest& request, const Solution& solution, std::size_t n) {
  const double* const residual = &solution.equations.residuals[2 * n];
  const UsedMark& mark = solution.used[n];
  return mark_text(request, mark.camera, mark.mark) + " is off by " +
         short_number(std::hypot(residual[0], residual[1]) * request.sigma_px) + " px";
}

/// Refuses a solution in which the ball cannot show a mark's point.
Result<> check_shown(const PlaceRequest& request, const Solution& solution) {
  const PlaceState& state = solution.state;
  for (const UsedMark& mark : solution.used) {
    const UnplacedCamera& camera = request.cameras[mark.camera];
    const auto picture = ball_picture(request, state, mark.camera);
    const optics::Vec3 offset = state.points[camera.marks[mark.mark].point] - state.centre;
    const double distance = norm(offset);
    if (picture && picture->pixel(offset * (1 / distance), 1 / distance)) continue;
    return fail(mark_text(request, mark.camera, mark.mark) +
                (distance > 1
                     ? " lies where the ball cannot show it: behind the ball, as its camera sees it"
                     : " lies within the ball"));
  }
  return {};
}

/// Checks a solution that no mark contradicts.
Result<> check_solution(const PlaceRequest& request, const Solution& solution) {
  if (auto shown = check_shown(request, solution); !shown) return shown;
  const Equations& equations = solution.equations;
  const double sum = equations.sum_of_squares();
  if (sum > chi_square_limit(equations.redundancy())) {
    return fail(
        "the marks, the outline and the points' coordinates contradict one another: reduced "
        "chi-square " +
        short_number(sum / equations.redundancy()) +
        "; check the ball's radius and the coordinates, or state larger sigmas");
  }
  return check_determined(request, solution);
}

tl::unexpected<Error> contradicted(const PlaceRequest& request, const Solution& solution,
                                   const Contradiction& wrong) {
  const std::string rival = wrong.rival ? ", or " + off_text(request, solution, *wrong.rival) : "";
  return fail("the marks contradict one another: " + off_text(request, solution, wrong.used) +
              rival + "; mark it again, or more points");
}

}  // namespace

std::optional<optics::BallProjection> ball_picture(const PlaceRequest& request,
                                                   const PlaceState& state, std::size_t camera) {
  const UnplacedCamera& unplaced = request.cameras[camera];
  const auto lens = lens_at(unplaced, state.cameras[camera].log_focal);
  if (!lens) return std::nullopt;
  return projection(unplaced, *lens, state.cameras[camera], state.centre, request.ball_radius);
}

Result<Solution> solve(const PlaceRequest& request) {
  const std::vector<UsedMark> all = all_marks(request);
  const auto best = best_state(request, all);
  if (!best) return tl::unexpected(best.error());
  PlaceState state = *best;
  for (std::vector<UsedMark> used = all;;) {
    auto solution = judged(request, used, state);
    if (!solution) return tl::unexpected(solution.error());
    const auto wrong =
        contradiction(solution->equations, solution->covariance, solution->used.size());
    if (!wrong) return check_solution(request, *solution).map([&] { return *solution; });
    const bool too_many = all.size() - used.size() >= all.size() / 3;
    if (wrong->rival || too_many) return contradicted(request, *solution, *wrong);
    used.erase(used.begin() + std::ptrdiff_t(wrong->used));
    const auto without = Adjustment(request, used).solve(state, false);
    if (!without) return contradicted(request, *solution, *wrong);
    state = *without;
  }
}

}  // namespace orbwatch::align
