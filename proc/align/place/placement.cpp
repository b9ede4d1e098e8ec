// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/placement.h"

#include <algorithm>
#include <cmath>

#include "proc/align/place/request_check.h"
#include "proc/align/place/solution.h"
#include "proc/align/place/uncertainty.h"

namespace orbwatch::align {
namespace {

std::vector<PlacedMark> placed_marks(const PlaceRequest& request, const Solution& solution,
                                     std::size_t c) {
  const PlaceState& state = solution.state;
  const UnplacedCamera& camera = request.cameras[c];
  const auto ball = ball_picture(request, state, c);
  std::vector<PlacedMark> all;
  for (std::size_t m = 0; m < camera.marks.size(); ++m) {
    PlacedMark placed;
    placed.is_outlier = std::ranges::none_of(
        solution.used, [&](const UsedMark& mark) { return mark.camera == c && mark.mark == m; });
    const optics::Vec3 offset = state.points[camera.marks[m].point] - state.centre;
    const double distance = norm(offset);
    const auto shown = ball ? ball->pixel(offset * (1 / distance), 1 / distance) : std::nullopt;
    const optics::Vec2& marked = camera.marks[m].pixel;
    if (shown) placed.residual = optics::Vec2{marked.u - shown->u, marked.v - shown->v};
    all.push_back(placed);
  }
  return all;
}

PlacedCamera placed_camera(const PlaceRequest& request, const Solution& solution, std::size_t c) {
  const CameraState& state = solution.state.cameras[c];
  const int first = int(c) * kCameraUnknowns;
  const double radius = request.ball_radius;
  PlacedCamera placed;
  placed.pose = {state.rotation,
                 (solution.state.centre - transposed(state.rotation) * state.ball) * radius};
  placed.lens = request.cameras[c].lens;
  if (request.cameras[c].focal_unknown) {
    placed.lens.fx *= std::exp(state.log_focal);
    placed.lens.fy *= std::exp(state.log_focal);
    placed.focal_sigma = placed.lens.fx * std::sqrt(solution.covariance(first + 6, first + 6));
  }
  placed.covariance = pose_covariance(request, solution.state, solution.covariance, c);
  const cv::Matx66d& p = placed.covariance;
  placed.rotation_sigma = optics::degrees(std::sqrt(p(0, 0) + p(1, 1) + p(2, 2)));
  placed.direction_sigma = view_sigma(request, solution.state, solution.covariance, c);
  placed.marks = placed_marks(request, solution, c);
  return placed;
}

cv::Matx33d centre_covariance(const PlaceRequest& request, const Solution& solution) {
  const int first = int(request.cameras.size()) * kCameraUnknowns;
  cv::Matx33d out;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      out(r, c) = solution.covariance(first + r, first + c) * std::pow(request.ball_radius, 2);
    }
  }
  return out;
}

}  // namespace

std::size_t add_point(PlaceRequest& request, const optics::Vec3& point) {
  const auto found = std::ranges::find_if(request.points, [&](const optics::Vec3& known) {
    return known.x == point.x && known.y == point.y && known.z == point.z;
  });
  const auto index = static_cast<std::size_t>(found - request.points.begin());
  if (found == request.points.end()) request.points.push_back(point);
  return index;
}

Result<Placement> place(const PlaceRequest& asked) {
  const PlaceRequest request = with_lenses(asked);
  if (auto checked = check_request(request); !checked) return tl::unexpected(checked.error());
  const auto found = solve(request);
  if (!found) return tl::unexpected(found.error());
  const Solution& solution = *found;
  Placement placement;
  placement.ball_centre = solution.state.centre * request.ball_radius;
  placement.ball_centre_covariance = centre_covariance(request, solution);
  placement.redundancy = solution.equations.redundancy();
  placement.reduced_chi_square = solution.equations.sum_of_squares() / placement.redundancy;
  for (std::size_t c = 0; c < request.cameras.size(); ++c) {
    placement.cameras.push_back(placed_camera(request, solution, c));
  }
  return placement;
}

}  // namespace orbwatch::align
