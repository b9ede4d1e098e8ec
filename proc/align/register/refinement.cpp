#include "proc/align/register/refinement.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "proc/align/register/rotation_fit.h"
#include "proc/optics/resolution.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Mat3;
using optics::Outline;
using optics::Vec2;
using optics::Vec3;

constexpr int kTurn = 3;     // a small turn about the reference frame's axes, radians
constexpr int kOutline = 3;  // centre and radius, shares of the radius
constexpr int kUnknowns = kTurn + kOutline;
constexpr double kStep = 1e-5;       // of derivatives
constexpr double kPixelSigma = 0.5;  // of a feature's place in either picture
constexpr double kRobustFrom = 1.5;  // sigmas
constexpr double kFits = 4;          // robust sigmas

using Unknowns = std::array<double, kUnknowns>;

/// The sought camera at a trial, and a step to either side of every unknown: once for all matches.
class Trial final : public ceres::EvaluationCallback {
 public:
  Trial(const SoughtCamera& sought, const Mat3& rotation, const Outline& outline)
      : sought_(sought), rotation_(rotation), outline_(outline) {}

  void PrepareForEvaluation(bool wants_derivatives, bool is_new_point) override {
    if (is_new_point) centre_ = at(unknowns);
    if (!wants_derivatives) return;
    for (std::size_t n = 0; n < kUnknowns; ++n) {
      for (const int side : {0, 1}) {
        Unknowns stepped = unknowns;
        stepped[n] += side == 0 ? -kStep : kStep;
        beside_[n][static_cast<std::size_t>(side)] = at(stepped);
      }
    }
  }

  Mat3 rotation() const {
    return rotation_about({unknowns[0], unknowns[1], unknowns[2]}) * rotation_;
  }
  Outline outline() const { return outline_at(unknowns); }

  const std::optional<BallProjection>& centre() const { return centre_; }
  const std::optional<BallProjection>& beside(std::size_t unknown, std::size_t side) const {
    return beside_[unknown][side];
  }

  Unknowns unknowns{};

 private:
  Outline outline_at(const Unknowns& x) const {
    Outline moved = outline_;
    const double radius = (outline_.rx + outline_.ry) / 2;
    moved.centre.u += x[3] * radius;
    moved.centre.v += x[4] * radius;
    moved.rx *= 1 + x[5];
    moved.ry *= 1 + x[5];
    return moved;
  }

  std::optional<BallProjection> at(const Unknowns& x) const {
    auto ball = turned(sought_, rotation_about({x[0], x[1], x[2]}) * rotation_, outline_at(x));
    return ball ? std::optional(*ball) : std::nullopt;
  }

  const SoughtCamera& sought_;
  Mat3 rotation_;
  Outline outline_;
  std::optional<BallProjection> centre_;
  std::array<std::array<std::optional<BallProjection>, 2>, kUnknowns> beside_;
};

/// What the reference camera sees at a match, and how exactly both know.
struct Sighted {
  Vec3 direction;
  Vec2 pixel;    ///< in the sought camera's picture
  double sigma;  ///< radians
};

/// The angle between both cameras' sights, in sigmas.
class Disagreement final : public ceres::CostFunction {
 public:
  Disagreement(const Trial& trial, const Sighted& sighted) : trial_(trial), sighted_(sighted) {
    set_num_residuals(3);
    mutable_parameter_block_sizes()->push_back(kTurn);
    mutable_parameter_block_sizes()->push_back(kOutline);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    const auto here = difference(trial_.centre());
    if (!here) return false;
    store(*here, residuals, 1);
    if (!jacobians) return true;
    for (std::size_t n = 0; n < kUnknowns; ++n) {
      const std::size_t block = n < kTurn ? 0 : 1, column = n < kTurn ? n : n - kTurn;
      if (!jacobians[block]) continue;
      const auto low = difference(trial_.beside(n, 0)), high = difference(trial_.beside(n, 1));
      const Vec3 slope = low && high ? (*high - *low) * (1 / (2 * kStep)) : Vec3{};
      // Across an edge of the scene the direction jumps and has no slope.
      constexpr double kSteepest = 1e3;
      const bool jumps = norm(slope) * sighted_.sigma > kSteepest;
      store(jumps ? Vec3{} : slope, jacobians[block] + column, 3);
    }
    return true;
  }

 private:
  std::optional<Vec3> difference(const std::optional<BallProjection>& ball) const {
    if (!ball) return std::nullopt;
    const auto direction = ball->direction(sighted_.pixel);
    // Outside of the limb of a trial: as bad as can be.
    if (!direction) return sighted_.direction * (1 / sighted_.sigma);
    return (*direction - sighted_.direction) * (1 / sighted_.sigma);
  }

  static void store(const Vec3& value, double* out, int stride) {
    out[0] = value.x;
    out[stride] = value.y;
    out[2 * stride] = value.z;
  }

  const Trial& trial_;
  Sighted sighted_;
};

/// What is known of the outline before.
struct OutlinePrior {
  double sigma;
  template <class T>
  bool operator()(const T* x, T* residuals) const {
    for (int n = 0; n < kOutline; ++n) residuals[n] = x[n] / sigma;
    return true;
  }
};

std::vector<Sighted> sighted(const std::vector<Match>& matches, const BallProjection& reference,
                             const BallProjection& camera) {
  std::vector<Sighted> all;
  for (const Match& match : matches) {
    const auto direction = reference.direction(match.reference);
    if (!direction) continue;
    const double a = optics::resolution(reference, *direction);
    const double b = optics::resolution(camera, *direction);
    if (!(a > 0 && b > 0)) continue;
    all.push_back(
        {*direction, match.camera, optics::radians(kPixelSigma * std::hypot(1 / a, 1 / b))});
  }
  return all;
}

/// The median error of the matches, in what a unit normal distribution in two dimensions has.
double spread(std::vector<double> errors) {
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle / 1.1774;
}

std::vector<double> errors(const std::vector<Sighted>& all, const BallProjection& ball) {
  std::vector<double> sigmas;
  for (const Sighted& one : all) {
    const auto direction = ball.direction(one.pixel);
    sigmas.push_back(direction ? norm(*direction - one.direction) / one.sigma
                               : std::numeric_limits<double>::infinity());
  }
  return sigmas;
}

class Problem {
 public:
  Problem(const SoughtCamera& sought, const Mat3& rotation, const Outline& outline)
      : trial_(sought, rotation, outline), outline_sigma_(sought.outline_sigma), problem_([this] {
          ceres::Problem::Options options;
          options.evaluation_callback = &trial_;
          return options;
        }()) {
    double* const turn = trial_.unknowns.data();
    problem_.AddParameterBlock(turn, kTurn);
    problem_.AddParameterBlock(turn + kTurn, kOutline);
    if (outline_sigma_ > 0) {
      problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<OutlinePrior, kOutline, kOutline>(
                                    new OutlinePrior{outline_sigma_}),
                                nullptr, turn + kTurn);
    } else {
      problem_.SetParameterBlockConstant(turn + kTurn);
    }
  }

  void add(const Sighted& sighted, ceres::LossFunction* loss) {
    double* const turn = trial_.unknowns.data();
    problem_.AddResidualBlock(new Disagreement(trial_, sighted), loss, turn, turn + kTurn);
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

  /// Of the turn, for matches whose sigma is right.
  std::optional<Mat3> covariance() {
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::DENSE_SVD;
    ceres::Covariance covariance(options);
    const double* const turn = trial_.unknowns.data();
    if (!covariance.Compute(std::vector<std::pair<const double*, const double*>>{{turn, turn}},
                            &problem_))
      return std::nullopt;
    std::array<double, 9> c{};
    if (!covariance.GetCovarianceBlock(turn, turn, c.data())) return std::nullopt;
    return Mat3{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}};
  }

  const Trial& trial() const { return trial_; }

 private:
  Trial trial_;
  double outline_sigma_;
  ceres::Problem problem_;
};

Mat3 scaled(const Mat3& m, double by) { return {m.row0 * by, m.row1 * by, m.row2 * by}; }

}  // namespace

Result<RotationRefinement> refine_rotation(const std::vector<Match>& matches,
                                           const BallProjection& reference,
                                           const SoughtCamera& sought, const Mat3& rotation,
                                           const Outline& outline) {
  const auto start = turned(sought, rotation, outline);
  if (!start) return tl::unexpected(start.error());
  const std::vector<Sighted> all = sighted(matches, reference, *start);
  if (all.size() < 3) return fail("too few features agree: three are needed at the very least");
  const double scale = std::max(0.2, spread(errors(all, *start)));
  Problem problem(sought, rotation, outline);
  // Bounded influence: what agrees by accident must not pull.
  for (const Sighted& one : all) problem.add(one, new ceres::CauchyLoss(kRobustFrom * scale));
  const auto covariance = problem.solve() ? problem.covariance() : std::nullopt;
  if (!covariance) return fail("the features do not determine the rotation");

  RotationRefinement result{problem.trial().rotation(), problem.trial().outline(), {}, 0, 0};
  const auto ball = turned(sought, result.rotation, result.outline);
  if (!ball) return tl::unexpected(ball.error());
  const auto left = errors(all, *ball);
  const double unit = std::max(0.1, spread(left));
  double squares = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (!(left[n] < kFits * unit)) continue;
    ++result.inliers;
    squares += left[n] * left[n] * all[n].sigma * all[n].sigma;
  }
  if (result.inliers == 0) return fail("no features agree");
  result.residual = optics::degrees(std::sqrt(squares / result.inliers));
  result.covariance = scaled(*covariance, unit * unit);
  return result;
}

}  // namespace orbwatch::align
