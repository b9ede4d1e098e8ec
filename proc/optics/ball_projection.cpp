// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/ball_projection.h"

#include <cmath>
#include <limits>
#include <string>

#include "proc/optics/rotation.h"

namespace orbwatch::optics {
namespace {

/// Iterations for a ray through a window and its displacement, which depend on each other. Each
/// iteration improves by about thickness / distance to the ball, so that a few suffice; a ray
/// almost along the glass may not converge and is not shown.
constexpr int kWindowRounds = 50;
constexpr double kWindowTolerance = 1e-12;  // share of that distance: radians

Result<> check_standing(const CalibratedCamera& camera, const Ball& ball) {
  const Vec3 offset = camera.pose.position - ball.centre;
  const double distance = norm(offset);
  if (!std::isfinite(distance)) return fail("the camera's position must be finite numbers");
  if (!(distance > ball.radius)) {
    return fail("the camera stands inside of the ball: " + std::to_string(distance) +
                " mm from its centre; its radius is " + std::to_string(ball.radius) + " mm");
  }
  if (!camera.lens.pixel(camera.pose.rotation * -offset)) {
    return fail("the camera's lens does not show the ball's centre: it looks another way");
  }
  if (!camera.window) return {};
  if (auto window = check_window(*camera.window); !window) return window;
  if (camera.window->thickness < distance - ball.radius) return {};
  return fail("the window is " + std::to_string(camera.window->thickness) +
              " mm thick; it must fit between the camera and the ball, " +
              std::to_string(distance - ball.radius) + " mm away");
}

}  // namespace

BallProjection::Viewpoint::Viewpoint(const Vec3& unit_facing, double distance_in_radii,
                                     const BallModel& ball_model)
    : facing(unit_facing),
      distance(distance_in_radii),
      model(ball_model),
      tan_limb(1 / std::sqrt((distance - 1) * (distance + 1))) {}

BallProjection::Viewpoint::Viewpoint(const Vec3& offset, BallModel::Kind kind)
    : Viewpoint(normalized(offset), norm(offset), BallModel::at_distance(kind, norm(offset))) {}

std::optional<BallProjection::Viewpoint::Scaled> BallProjection::Viewpoint::place(
    const Vec3& direction, double closeness) const {
  const double cosine = dot(direction, facing);
  const Vec3 across = direction - facing * cosine;
  const auto stretch = model.stretch(cosine, dot(across, across), closeness);
  // An orthographic camera's whole limb shows the point straight behind the ball.
  if (!stretch || !(stretch->along > 0)) return std::nullopt;
  return Scaled{across, *stretch};
}

void BallProjection::Viewpoint::places(const Vec3Lanes& directions, const Lanes& closeness,
                                       ScaledLanes& out) const {
  const Vec3 axis = facing;  // a copy, so that no store into `out` could change it
  Lanes cosine, sin2;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vec3 direction = directions.at(k);
    cosine[k] = dot(direction, axis);
    const Vec3 across = direction - axis * cosine[k];
    sin2[k] = dot(across, across);
    out.across.set(k, across);
  }
  model.stretch(cosine, sin2, closeness, out.stretch);
}

std::optional<Vec3> BallProjection::Viewpoint::place_of_camera_ray(const Vec3& ray) const {
  const double along = -dot(ray, facing);
  if (!(along > 0)) return std::nullopt;
  return (ray + facing * along) * (1 / (along * tan_limb));
}

std::optional<Ray> BallProjection::Viewpoint::reflected(const Vec3& place) const {
  const double rho = norm(place);
  const auto phi = model.phi(rho);
  if (!phi) return std::nullopt;
  const Vec3 across = rho > 0 ? place * (1 / rho) : Vec3{};
  const auto towards = [&](const CosSin& a) { return facing * a.cos + across * a.sin; };
  return Ray{model.has_parallax() ? towards(model.theta(rho)) : Vec3{}, towards(*phi)};
}

BallProjection::LimbPicture::LimbPicture(const Outline& limb, const Mat3& registration)
    : outline(limb) {
  // The picture of a camera on +Y that looks along -Y.
  const Vec3 right = -registration.column0(), down = -registration.column2();
  const double c = std::cos(radians(limb.angle)), s = std::sin(radians(limb.angle));
  const Vec3 along = right * c + down * s, across = down * c - right * s;
  u = along * (limb.rx * c) - across * (limb.ry * s);
  v = along * (limb.rx * s) + across * (limb.ry * c);
  place_per_u = along * (c / limb.rx) - across * (s / limb.ry);
  place_per_v = along * (s / limb.rx) + across * (c / limb.ry);
}

Vec3 BallProjection::LimbPicture::place(const Vec2& pixel) const {
  return place_per_u * (pixel.u - outline.centre.u) + place_per_v * (pixel.v - outline.centre.v);
}

BallProjection::BallProjection(const Viewpoint& viewpoint,
                               const std::variant<LimbPicture, CalibratedCamera>& picture,
                               const Ball& ball, const SceneProxy& proxy)
    : viewpoint_(viewpoint), picture_(picture), ball_(ball), proxy_(proxy) {}

Result<BallProjection> BallProjection::make(const BallModel& model, const Outline& outline,
                                            const Mat3& registration, const Ball& ball,
                                            const SceneProxy& proxy) {
  if (auto ellipse = check_ellipse(outline); !ellipse) return tl::unexpected(ellipse.error());
  if (auto good = check_ball(ball); !good) return tl::unexpected(good.error());
  return checked_rotation(registration).map([&](const Mat3& rotation) {
    return BallProjection(Viewpoint(rotation.column1(), model.distance(), model),
                          LimbPicture(outline, rotation), ball, proxy);
  });
}

Result<BallProjection> BallProjection::make(BallModel::Kind kind, const CalibratedCamera& camera,
                                            const Ball& ball, const SceneProxy& proxy) {
  if (auto good = check_ball(ball); !good) return tl::unexpected(good.error());
  if (auto pose = checked_rotation(camera.pose.rotation); !pose) {
    return tl::unexpected(pose.error());
  }
  if (auto stands = check_standing(camera, ball); !stands) return tl::unexpected(stands.error());
  const Vec3 offset = (camera.pose.position - ball.centre) * (1 / ball.radius);
  return BallProjection(Viewpoint(offset, kind), camera, ball, proxy);
}

std::optional<Vec2> BallProjection::pixel(const Vec3& direction) const {
  const bool has_parallax = viewpoint_.model.has_parallax();
  return pixel(direction, has_parallax ? proxy_.hit(direction).closeness : 0);
}

std::optional<Vec2> BallProjection::pixel(const Vec3& direction, double closeness) const {
  const auto* camera = std::get_if<CalibratedCamera>(&picture_);
  if (camera && camera->window) return pixel_through_window(*camera, direction, closeness);
  const auto place = viewpoint_.place(direction, closeness);
  if (!place) return std::nullopt;
  if (camera) return camera->lens.pixel(camera->pose.rotation * viewpoint_.camera_ray(*place));
  return std::get<LimbPicture>(picture_).pixel(*place);
}

void BallProjection::pixels(const Vec3Lanes& directions, const Lanes& closeness,
                            Vec2Lanes& out) const {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  const auto set = [&](std::size_t k, const std::optional<Vec2>& pixel) {
    out.u[k] = pixel ? pixel->u : kNothing;
    out.v[k] = pixel ? pixel->v : kNothing;
  };
  const auto* camera = std::get_if<CalibratedCamera>(&picture_);
  if (camera && camera->window) {
    for (std::size_t k = 0; k < kLanes; ++k) set(k, pixel(directions.at(k), closeness[k]));
    return;
  }
  Viewpoint::ScaledLanes places;
  viewpoint_.places(directions, closeness, places);
  const auto place = [&](std::size_t k) {
    return Viewpoint::Scaled{places.across.at(k),
                             {places.stretch.across[k], places.stretch.along[k]}};
  };
  if (camera) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const bool shown = places.stretch.along[k] > 0;
      const auto ray = [&] { return camera->pose.rotation * viewpoint_.camera_ray(place(k)); };
      set(k, shown ? camera->lens.pixel(ray()) : std::nullopt);
    }
    return;
  }
  const LimbPicture limb = std::get<LimbPicture>(picture_);
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vec2 at = limb.pixel(place(k));
    out.u[k] = at.u;
    out.v[k] = at.v;
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    out.u[k] = places.stretch.along[k] > 0 ? out.u[k] : kNothing;
  }
}

BallProjection::Viewpoint BallProjection::seen_from(const Vec3& position) const {
  return {(position - ball_.centre) * (1 / ball_.radius), viewpoint_.model.kind()};
}

std::optional<Vec2> BallProjection::pixel_through_window(const CalibratedCamera& camera,
                                                         const Vec3& direction,
                                                         double closeness) const {
  const double tolerance = kWindowTolerance * viewpoint_.distance * ball_.radius;
  Vec3 shift = displacement(*camera.window, -viewpoint_.facing);
  for (int round = 0; round < kWindowRounds; ++round) {
    const Viewpoint viewpoint = seen_from(camera.pose.position + shift);
    const auto place = viewpoint.place(direction, closeness);
    // The glass displaces a ray against its tilt, so that the ball shows less there: a direction
    // behind the limb stays behind it.
    if (!place) return std::nullopt;
    const Vec3 ray = normalized(viewpoint.camera_ray(*place));
    const Vec3 next = displacement(*camera.window, ray);
    if (norm(next - shift) < tolerance) return camera.lens.pixel(camera.pose.rotation * ray);
    shift = next;
  }
  return std::nullopt;
}

std::optional<Ray> BallProjection::reflected(const Vec2& pixel) const {
  const auto* camera = std::get_if<CalibratedCamera>(&picture_);
  if (!camera) return viewpoint_.reflected(std::get<LimbPicture>(picture_).place(pixel));
  const auto seen = camera->lens.direction(pixel);
  if (!seen) return std::nullopt;
  const Vec3 ray = transposed(camera->pose.rotation) * *seen;
  const Viewpoint viewpoint =
      camera->window ? seen_from(camera->pose.position + displacement(*camera->window, ray))
                     : viewpoint_;
  const auto place = viewpoint.place_of_camera_ray(ray);
  return place ? viewpoint.reflected(*place) : std::nullopt;
}

std::optional<Ray> BallProjection::ray(const Vec2& pixel) const {
  const auto ray = reflected(pixel);
  if (!ray) return std::nullopt;
  return Ray{ball_.centre + ray->origin * ball_.radius, ray->direction};
}

std::optional<Vec3> BallProjection::direction(const Vec2& pixel) const {
  const auto ray = reflected(pixel);
  if (!ray) return std::nullopt;
  if (!viewpoint_.model.has_parallax()) return ray->direction;
  const auto point = proxy_.meet(*ray);
  return point ? normalized(*point) : ray->direction;
}

std::optional<Outline> BallProjection::outline() const {
  const auto* camera = std::get_if<CalibratedCamera>(&picture_);
  if (!camera) return std::get<LimbPicture>(picture_).outline;
  // Convert to camera frame and ball radii.
  const Mat3& rotation = camera->pose.rotation;
  Window window = camera->window.value_or(Window{});
  window.normal = rotation * window.normal;
  window.thickness /= ball_.radius;
  const auto limb = outline_from_sight({rotation * -viewpoint_.facing, viewpoint_.distance},
                                       camera->lens, window);
  return limb ? std::optional(*limb) : std::nullopt;
}

}  // namespace orbwatch::optics
