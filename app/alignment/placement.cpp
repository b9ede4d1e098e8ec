// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/placement.h"

#include <cmath>
#include <sstream>
#include <utility>

namespace orbwatch::app {
namespace {

using optics::Vec3;

std::string text_of(const Vec3& p) {
  std::ostringstream text;
  text.precision(4);
  text << "(" << p.x << ", " << p.y << ", " << p.z << " mm)";
  return text.str();
}

}  // namespace

Result<align::UnplacedCamera> unplaced_camera(const optics::RigCamera& camera, bool focal_unknown) {
  if (camera.model != optics::BallModel::Kind::Exact) {
    return fail("camera " + camera.name + ": only the exact model knows distances");
  }
  if (!camera.intrinsics && !focal_unknown) {
    return fail("camera " + camera.name +
                " has no intrinsics in the rig; calibrate it, or give `orbwatch place` --focal "
                "unknown");
  }
  align::UnplacedCamera out;
  out.name = camera.name;
  out.focal_unknown = focal_unknown;
  if (!focal_unknown) out.lens = *camera.intrinsics;
  out.lens.width = camera.width;
  out.lens.height = camera.height;
  out.window = camera.window;
  return out;
}

align::PlaceRequest place_request(const optics::Rig& rig, const PlacePrecision& precision,
                                  align::BallCentre::Knowledge centre, double centre_sigma) {
  align::PlaceRequest request;
  request.centre = {centre, rig.ball.centre, centre_sigma};
  request.ball_radius = rig.ball.radius;
  request.sigma_px = precision.sigma_px;
  request.sigma_mm = precision.sigma_mm;
  return request;
}

Result<> add_camera(align::PlaceRequest& request, align::UnplacedCamera camera,
                    std::span<const KnownPoint> points, const Picture* picture,
                    std::span<const align::PrintedTag> tags, const align::WorkProgress& progress) {
  for (const auto& [pixel, point] : points) {
    camera.marks.push_back({align::add_point(request, point), pixel});
  }
  if (picture && !tags.empty()) {
    const auto shown = align::mark_tags(*picture, tags, camera, request, progress);
    if (!shown) return tl::unexpected(shown.error());
  }
  request.cameras.push_back(std::move(camera));
  return {};
}

Result<RigAlignment> rig_alignment(const align::PlaceRequest& request,
                                   const align::Placement& placement) {
  RigAlignment alignment;
  if (request.centre.knowledge != align::BallCentre::Knowledge::Known) {
    alignment.ball_centre = placement.ball_centre;
  }
  for (std::size_t c = 0; c < placement.cameras.size(); ++c) {
    const align::PlacedCamera& placed = placement.cameras[c];
    const align::UnplacedCamera& camera = request.cameras[c];
    for (std::size_t m = 0; m < placed.marks.size(); ++m) {
      const align::PlacedMark& mark = placed.marks[m];
      if (!mark.is_outlier) continue;
      std::ostringstream text;
      text.precision(4);
      text << "camera " << camera.name << ": the point "
           << text_of(request.points[camera.marks[m].point]) << " contradicts the others";
      if (mark.residual) text << " by " << std::hypot(mark.residual->u, mark.residual->v) << " px";
      text << "; mark it again or leave it out: nothing is written";
      return fail(text.str());
    }
    CameraAlignment aligned{camera.name};
    aligned.pose = placed.pose;
    if (camera.focal_unknown) aligned.intrinsics = placed.lens;
    alignment.cameras.push_back(aligned);
  }
  return alignment;
}

double rms_residual(const align::PlacedCamera& camera) {
  double squares = 0;
  std::size_t count = 0;
  for (const align::PlacedMark& mark : camera.marks) {
    if (!mark.residual) continue;
    squares += mark.residual->u * mark.residual->u + mark.residual->v * mark.residual->v;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
}

std::vector<PlacedPoint> placed_points(const align::PlaceRequest& request,
                                       const align::Placement& placement, std::size_t camera) {
  const std::vector<align::PointMark>& marks = request.cameras[camera].marks;
  const std::vector<align::PlacedMark>& placed = placement.cameras[camera].marks;
  std::vector<PlacedPoint> points;
  for (std::size_t m = 0; m < marks.size(); ++m) {
    points.push_back(
        {request.points[marks[m].point], marks[m].pixel, placed[m].residual, placed[m].is_outlier});
  }
  return points;
}

std::string residuals_text(const align::PlaceRequest& request, const align::Placement& placement,
                           std::size_t c) {
  std::ostringstream text;
  text.precision(2);
  text << std::fixed;
  const align::PlacedCamera& placed = placement.cameras[c];
  for (std::size_t m = 0; m < placed.marks.size(); ++m) {
    const align::PlacedMark& mark = placed.marks[m];
    text << (m == 0 ? "" : "; ") << text_of(request.points[request.cameras[c].marks[m].point]);
    if (mark.residual) {
      text << " " << mark.residual->u << ", " << mark.residual->v << " px";
    } else {
      text << " not shown";
    }
  }
  return text.str();
}

}  // namespace orbwatch::app
