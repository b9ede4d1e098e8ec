// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/request_check.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "proc/optics/scene_proxy.h"

namespace orbwatch::align {
namespace {

using optics::Vec2;
using optics::Vec3;

/// Limit for a mark outside of the outline: errors of both, in sigmas.
constexpr double kMostSigmas = 3;

bool is_finite(const Vec3& v) { return std::isfinite(v.x + v.y + v.z); }
bool is_sigma(double sigma) { return sigma > 0 && std::isfinite(sigma); }

Result<> check_ball(const PlaceRequest& request) {
  const bool known = request.centre.knowledge != BallCentre::Knowledge::Unknown;
  const Vec3 centre = known ? request.centre.position : Vec3{};
  if (auto ball = optics::check_ball({centre, request.ball_radius}); !ball) return ball;
  const bool measured = request.centre.knowledge == BallCentre::Knowledge::Measured;
  if (measured && !is_sigma(request.centre.sigma)) {
    return fail("the sigma of the ball's centre must be above 0 mm");
  }
  return {};
}

Result<> check_points(const PlaceRequest& request) {
  if (!is_sigma(request.sigma_px)) return fail("the sigma of marks must be above 0 px");
  if (!(request.sigma_mm >= 0) || !std::isfinite(request.sigma_mm)) {
    return fail("the sigma of points must be 0 mm or more");
  }
  for (std::size_t p = 0; p < request.points.size(); ++p) {
    const Vec3& point = request.points[p];
    if (!is_finite(point)) {
      return fail("point " + std::to_string(p + 1) + ": its coordinates must be finite numbers");
    }
    if (request.centre.knowledge == BallCentre::Knowledge::Unknown) continue;
    const double distance = norm(point - request.centre.position);
    if (distance > request.ball_radius + 3 * request.centre.sigma) continue;
    return fail(point_text(request, p) + " lies within the ball: " + short_number(distance) +
                " mm from its centre; the radius is " + short_number(request.ball_radius) + " mm");
  }
  return {};
}

/// Distance of a pixel from the limb towards the centre, px; negative within the ball.
double distance_outside(const optics::Outline& outline, const Vec2& pixel) {
  const double relative = optics::relative_distance(outline, pixel);
  if (relative == 0) return -outline.rx;
  const double du = pixel.u - outline.centre.u, dv = pixel.v - outline.centre.v;
  return std::hypot(du, dv) * (1 - 1 / relative);
}

Result<> check_marks(const PlaceRequest& request, std::size_t c) {
  const UnplacedCamera& camera = request.cameras[c];
  for (std::size_t m = 0; m < camera.marks.size(); ++m) {
    const PointMark& mark = camera.marks[m];
    if (mark.point >= request.points.size()) {
      return fail("camera " + camera.name + " marks point " + std::to_string(mark.point + 1) +
                  "; there are " + std::to_string(request.points.size()));
    }
    if (!std::isfinite(mark.pixel.u) || !std::isfinite(mark.pixel.v)) {
      return fail("camera " + camera.name + ": " + point_text(request, mark.point) +
                  ": its pixel must be finite numbers");
    }
    const double most = kMostSigmas * std::hypot(request.sigma_px, camera.outline_sigma);
    const double outside = distance_outside(camera.outline, mark.pixel);
    if (outside > most) {
      return fail(mark_text(request, c, m) + " lies " + short_number(outside) +
                  " px outside of the ball's outline; the sigmas permit " + short_number(most) +
                  " px");
    }
  }
  return {};
}

Result<> check_camera(const PlaceRequest& request, std::size_t c) {
  const UnplacedCamera& camera = request.cameras[c];
  const std::string name = "camera " + camera.name + ": ";
  const auto about = [&name](const Error& error) { return Error{name + error.message}; };
  if (auto lens = optics::Lens::make(camera.lens).map_error(about); !lens) {
    return tl::unexpected(lens.error());
  }
  if (auto ellipse = optics::check_ellipse(camera.outline).map_error(about); !ellipse) {
    return ellipse;
  }
  if (!is_sigma(camera.outline_sigma)) {
    return fail(name + "the sigma of the outline must be above 0 px");
  }
  if (camera.window) {
    if (camera.focal_unknown) {
      return fail(name + "behind a window the focal length must be known");
    }
    if (auto window = optics::check_window(*camera.window).map_error(about); !window) {
      return window;
    }
  }
  if (!camera.focal_unknown) {
    const auto sight = optics::sight_from_outline(camera.outline, *optics::Lens::make(camera.lens))
                           .map_error(about);
    if (!sight) return tl::unexpected(sight.error());
  }
  return check_marks(request, c);
}

/// Counts a point that is marked several times once.
std::size_t distinct_points(const UnplacedCamera& camera) {
  std::set<std::size_t> points;
  for (const PointMark& mark : camera.marks) points.insert(mark.point);
  return points.size();
}

std::string needs_text(const PlaceRequest& request) {
  std::string unknowns = "the pose";
  if (request.cameras.size() > 1) unknowns += "s";
  if (request.centre.knowledge == BallCentre::Knowledge::Unknown) unknowns += ", the ball's centre";
  const bool focal = std::ranges::any_of(request.cameras, &UnplacedCamera::focal_unknown);
  if (focal) unknowns += ", the focal length";
  return unknowns;
}

Result<> check_count(const PlaceRequest& request) {
  std::size_t marks = 0;
  for (const UnplacedCamera& camera : request.cameras) {
    const std::size_t own = distinct_points(camera);
    marks += own;
    if (own >= kLeastMarksPerCamera) continue;
    return fail("camera " + camera.name + " has " + std::to_string(own) + " marked points; " +
                std::to_string(kLeastMarksPerCamera) + " are needed at least");
  }
  const std::size_t least = least_marks(request);
  if (marks >= least) return {};
  return fail(std::to_string(marks) + " marked points are too few: " + needs_text(request) +
              ", and one equation more that shows mistakes, need " + std::to_string(least));
}

}  // namespace

std::string short_number(double value) {
  std::ostringstream out;
  out.precision(std::abs(value) >= 100 ? 4 : 3);
  out << value;
  return out.str();
}

std::string point_text(const PlaceRequest& request, std::size_t point) {
  const Vec3& p = request.points[point];
  std::ostringstream out;
  out << "point " << point + 1 << " (" << p.x << ", " << p.y << ", " << p.z << " mm)";
  return out.str();
}

std::string mark_text(const PlaceRequest& request, std::size_t camera, std::size_t mark) {
  const PointMark& m = request.cameras[camera].marks[mark];
  std::ostringstream out;
  out << "camera " << request.cameras[camera].name << ": " << point_text(request, m.point)
      << ", marked at (" << m.pixel.u << ", " << m.pixel.v << "),";
  return out.str();
}

std::size_t least_marks(const PlaceRequest& request) {
  // The outline gives the ball in the camera frame; a mark gives two equations.
  std::size_t unknowns = 3 * request.cameras.size();
  if (request.centre.knowledge == BallCentre::Knowledge::Unknown) unknowns += 3;
  for (const UnplacedCamera& camera : request.cameras) unknowns += camera.focal_unknown ? 1 : 0;
  return std::max((unknowns + 2) / 2, kLeastMarksPerCamera * request.cameras.size());
}

PlaceRequest with_lenses(const PlaceRequest& request) {
  PlaceRequest complete = request;
  for (UnplacedCamera& camera : complete.cameras) {
    if (!camera.focal_unknown) continue;
    const int width = camera.lens.width, height = camera.lens.height;
    const double focal = std::max(width, height);
    camera.lens = {width, height, focal, focal, (width - 1) / 2.0, (height - 1) / 2.0};
  }
  return complete;
}

Result<> check_request(const PlaceRequest& request) {
  if (request.cameras.empty()) return fail("there is no camera to place");
  if (auto ball = check_ball(request); !ball) return ball;
  if (auto points = check_points(request); !points) return points;
  for (std::size_t c = 0; c < request.cameras.size(); ++c) {
    if (auto camera = check_camera(request, c); !camera) return camera;
  }
  return check_count(request);
}

}  // namespace orbwatch::align
