// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/adjustment.h"

#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/numeric_diff_cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "proc/align/prior.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::align {
namespace {

using optics::Mat3;
using optics::Vec2;
using optics::Vec3;

Vec3 vec3(const double* x) { return {x[0], x[1], x[2]}; }

Mat3 turned(const Vec3& turn, const Mat3& rotation) { return rotation_about(turn) * rotation; }

/// The solver's unknowns as flat numbers; turns are relative to the start.
struct Blocks {
  explicit Blocks(const PlaceState& state) : start(state) {
    centre = {state.centre.x, state.centre.y, state.centre.z};
    for (const Vec3& p : state.points) points.push_back({p.x, p.y, p.z});
    for (const CameraState& c : state.cameras) {
      turns.push_back({0, 0, 0});
      balls.push_back({c.ball.x, c.ball.y, c.ball.z});
      focals.push_back(c.log_focal);
    }
  }

  PlaceState state() const {
    PlaceState state{vec3(centre.data()), {}, {}};
    for (const auto& p : points) state.points.push_back(vec3(p.data()));
    for (std::size_t c = 0; c < turns.size(); ++c) {
      state.cameras.push_back({turned(vec3(turns[c].data()), start.cameras[c].rotation),
                               vec3(balls[c].data()), focals[c]});
    }
    return state;
  }

  const PlaceState& start;
  std::array<double, 3> centre{};
  std::vector<std::array<double, 3>> points, turns, balls;
  std::vector<double> focals;
};

/// The pixel at which the ball shows a point (radii). A hidden point lies beyond the limb, the
/// further the deeper it is hidden: a solver on its way must not end there. nullopt if the lens
/// shows nothing there.
std::optional<Vec2> pixel_or_beyond(const optics::BallProjection& picture, const Vec3& point) {
  constexpr double kNearest = 1 + 1e-6;  // least distance of a point, also of one within the ball
  const Vec3 offset = point - picture.ball().centre;
  const double closeness = 1 / std::max(norm(offset), kNearest);
  const Vec3 direction = normalized(offset), facing = picture.facing();
  if (const auto shown = picture.pixel(direction, closeness)) return shown;
  // A ray along the limb leads to the angle acos p + acos q.
  constexpr double kInside = 1e-6;
  const double limb = std::acos(closeness) + std::acos(1 / picture.distance()) - kInside;
  const Vec3 across = normalized(direction - facing * dot(direction, facing));
  const auto edge = picture.pixel(facing * std::cos(limb) + across * std::sin(limb), closeness);
  const auto middle = picture.pixel(facing, 0);
  if (!edge || !middle) return std::nullopt;
  const double beyond = 1 + optics::angle_between(direction, facing) - limb;
  return Vec2{middle->u + (edge->u - middle->u) * beyond,
              middle->v + (edge->v - middle->v) * beyond};
}

/// Common parts of a camera's equations.
struct CameraEquation {
  const PlaceRequest& request;
  const UnplacedCamera& camera;
  Mat3 rotation;  ///< to which turns are relative
  /// Set if the lens is fixed: a distorted one takes long to make.
  std::optional<optics::Lens> known_lens;

  std::optional<optics::BallProjection> at(const double* turn, const double* ball,
                                           const double* focal, const Vec3& centre) const {
    const auto lens = known_lens ? *known_lens : lens_at(camera, *focal);
    if (!lens) return std::nullopt;
    return projection(camera, *lens, {turned(vec3(turn), rotation), vec3(ball), *focal}, centre,
                      request.ball_radius);
  }
};

/// Residual that rejects steps to a state without a picture.
constexpr double kNoPicture = 1e6;

struct MarkEquation : CameraEquation {
  Vec2 pixel;

  bool operator()(const double* turn, const double* ball, const double* focal, const double* centre,
                  const double* point, double* residual) const {
    const auto picture = at(turn, ball, focal, vec3(centre));
    const auto shown = picture ? pixel_or_beyond(*picture, vec3(point)) : std::nullopt;
    residual[0] = shown ? (pixel.u - shown->u) / request.sigma_px : kNoPicture;
    residual[1] = shown ? (pixel.v - shown->v) / request.sigma_px : kNoPicture;
    return true;
  }
};

/// The limb has three figures: its place and its size. Its shape follows from them.
struct OutlineEquation : CameraEquation {
  bool operator()(const double* turn, const double* ball, const double* focal,
                  double* residual) const {
    const auto picture = at(turn, ball, focal, {});
    const auto shown = picture ? picture->outline() : std::nullopt;
    std::fill_n(residual, 3, kNoPicture);
    if (!shown) return true;
    const optics::Outline& seen = camera.outline;
    residual[0] = (seen.centre.u - shown->centre.u) / camera.outline_sigma;
    residual[1] = (seen.centre.v - shown->centre.v) / camera.outline_sigma;
    residual[2] = (seen.rx + seen.ry - shown->rx - shown->ry) / 2 / camera.outline_sigma;
    return true;
  }
};

/// Equations of a measured position with that sigma, ball radii.
ceres::CostFunction* measured(const Vec3& position, double sigma) {
  return new Prior({position.x, position.y, position.z}, sigma);
}

/// The request as a Ceres problem.
class Problem {
 public:
  Problem(const PlaceRequest& request, const std::vector<UsedMark>& used, const PlaceState& start,
          bool robust)
      : request_(request), blocks_(start) {
    for (const UsedMark& mark : used) add_mark(mark, robust);
    for (std::size_t c = 0; c < request.cameras.size(); ++c) add_outline(c);
    add_centre();
    for (std::size_t p = 0; p < request.points.size(); ++p) add_point(p);
  }

  std::optional<PlaceState> solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-12;
    options.parameter_tolerance = 1e-10;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    if (!summary.IsSolutionUsable()) return std::nullopt;
    return blocks_.state();
  }

  std::optional<Equations> equations() {
    ceres::Problem::EvaluateOptions options;
    options.apply_loss_function = false;
    options.residual_blocks = residuals_;
    std::vector<int> columns;
    for (const auto& [block, column, size] : unknown_) {
      options.parameter_blocks.push_back(block);
      for (int k = 0; k < size; ++k) columns.push_back(column + k);
    }
    Equations all;
    ceres::CRSMatrix sparse;
    if (!problem_.Evaluate(options, nullptr, &all.residuals, nullptr, &sparse)) return std::nullopt;
    all.unknowns = columns;
    all.jacobian = cv::Mat1d::zeros(int(all.residuals.size()), columns_);
    for (int row = 0; row < sparse.num_rows; ++row) {
      for (int k = sparse.rows[std::size_t(row)]; k < sparse.rows[std::size_t(row) + 1]; ++k) {
        const auto column = std::size_t(sparse.cols[std::size_t(k)]);
        all.jacobian(row, columns[column]) = sparse.values[std::size_t(k)];
      }
    }
    return all;
  }

 private:
  struct Unknown {
    double* block;
    int column;
    int size;
  };

  /// Declares a block that the equations use, as unknown or as constant.
  void settle(double* block, int size, int column, bool known) {
    columns_ = std::max(columns_, column + size);
    if (known) {
      if (problem_.HasParameterBlock(block)) problem_.SetParameterBlockConstant(block);
    } else {
      unknown_.push_back({block, column, size});
    }
  }

  CameraEquation equation(std::size_t camera) const {
    const UnplacedCamera& unplaced = request_.cameras[camera];
    const CameraState& start = blocks_.start.cameras[camera];
    CameraEquation equation{request_, unplaced, start.rotation, std::nullopt};
    if (unplaced.focal_unknown) return equation;
    if (auto lens = lens_at(unplaced, start.log_focal)) equation.known_lens = *lens;
    return equation;
  }

  void add_mark(const UsedMark& used, bool robust) {
    const PointMark& mark = request_.cameras[used.camera].marks[used.mark];
    auto* cost = new ceres::NumericDiffCostFunction<MarkEquation, ceres::CENTRAL, 2, 3, 3, 1, 3, 3>(
        new MarkEquation{equation(used.camera), mark.pixel});
    residuals_.push_back(problem_.AddResidualBlock(
        cost, robust ? new ceres::CauchyLoss(2.0) : nullptr, blocks_.turns[used.camera].data(),
        blocks_.balls[used.camera].data(), &blocks_.focals[used.camera], blocks_.centre.data(),
        blocks_.points[mark.point].data()));
  }

  void add_outline(std::size_t c) {
    auto* cost = new ceres::NumericDiffCostFunction<OutlineEquation, ceres::CENTRAL, 3, 3, 3, 1>(
        new OutlineEquation{equation(c)});
    residuals_.push_back(problem_.AddResidualBlock(cost, nullptr, blocks_.turns[c].data(),
                                                   blocks_.balls[c].data(), &blocks_.focals[c]));
    const int column = int(c) * kCameraUnknowns;
    settle(blocks_.turns[c].data(), 3, column, false);
    settle(blocks_.balls[c].data(), 3, column + 3, false);
    settle(&blocks_.focals[c], 1, column + 6, !request_.cameras[c].focal_unknown);
  }

  void add_centre() {
    const BallCentre& centre = request_.centre;
    double* const block = blocks_.centre.data();
    if (centre.knowledge == BallCentre::Knowledge::Measured) {
      const double radius = request_.ball_radius;
      residuals_.push_back(problem_.AddResidualBlock(
          measured(centre.position * (1 / radius), centre.sigma / radius), nullptr, block));
    }
    settle(block, 3, int(request_.cameras.size()) * kCameraUnknowns,
           centre.knowledge == BallCentre::Knowledge::Known);
  }

  void add_point(std::size_t p) {
    double* const block = blocks_.points[p].data();
    const int column = int(request_.cameras.size()) * kCameraUnknowns + 3 + int(p) * 3;
    const bool used = problem_.HasParameterBlock(block), exact = request_.sigma_mm == 0;
    if (used && !exact) {
      const double radius = request_.ball_radius;
      residuals_.push_back(problem_.AddResidualBlock(
          measured(request_.points[p] * (1 / radius), request_.sigma_mm / radius), nullptr, block));
    }
    settle(block, 3, column, exact || !used);
  }

  const PlaceRequest& request_;
  Blocks blocks_;
  ceres::Problem problem_;
  std::vector<ceres::ResidualBlockId> residuals_;
  std::vector<Unknown> unknown_;
  int columns_ = 0;
};

}  // namespace

Result<optics::Lens> lens_at(const UnplacedCamera& camera, double log_focal) {
  optics::Intrinsics intrinsics = camera.lens;
  intrinsics.fx *= std::exp(log_focal);
  intrinsics.fy *= std::exp(log_focal);
  return optics::Lens::make(intrinsics);
}

std::optional<optics::BallProjection> projection(const UnplacedCamera& camera,
                                                 const optics::Lens& lens, const CameraState& state,
                                                 const Vec3& centre, double ball_radius) {
  auto window = camera.window;
  if (window) window->thickness /= ball_radius;
  const optics::Pose pose{state.rotation, centre - transposed(state.rotation) * state.ball};
  auto made = optics::BallProjection::make(optics::BallModel::Kind::Exact, {lens, pose, window},
                                           {centre, 1});
  return made ? std::optional(*made) : std::nullopt;
}

double Equations::sum_of_squares() const {
  return std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
}

CameraState changed(const CameraState& state, const CameraChange& change) {
  return {turned({change[0], change[1], change[2]}, state.rotation),
          state.ball + Vec3{change[3], change[4], change[5]}, state.log_focal + change[6]};
}

std::optional<PlaceState> Adjustment::solve(const PlaceState& start, bool robust) const {
  return Problem(request_, used_, start, robust).solve();
}

std::optional<Equations> Adjustment::equations(const PlaceState& state) const {
  return Problem(request_, used_, state, false).equations();
}

}  // namespace orbwatch::align
