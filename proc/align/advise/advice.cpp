// SPDX-License-Identifier: Apache-2.0
#include "proc/align/advise/advice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

#include "proc/image/picture.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/resolution.h"

namespace orbwatch::align {
namespace {

using optics::Vec3;

constexpr std::array kAngles{0.0, 60.0, 90.0, 120.0, 150.0};
/// The ball's diameter relative to the picture's short side: wanted, and too small below.
constexpr double kGoodFill = 0.9, kPoorFill = 0.7;
constexpr double kAiryPixels = 2;       // px across the Airy disc
constexpr double kWavelength = 550e-6;  // mm
/// F-number above which a lens is stopped down so far that little light is left.
constexpr double kDarkFNumber = 16;

Result<> check(const Arrangement& s) {
  struct Length {
    std::string_view name;
    double value;
  };
  for (const auto& [name, value] :
       {Length{"ball's diameter", s.ball_diameter}, Length{"distance", s.distance},
        Length{"focal length", s.focal_length}, Length{"pixel pitch", s.pixel},
        Length{"target's distance", s.target_distance},
        Length{"smallest thing", s.smallest.value_or(1)}}) {
    if (!(value > 0) || !std::isfinite(value)) {
      return fail("the " + std::string(name) + " must be above 0 and finite");
    }
  }
  if (s.sensor_width < 1 || s.sensor_height < 1 || s.sensor_width > kMaxSide ||
      s.sensor_height > kMaxSide) {
    return fail("the sensor must have 1x1 to 16384x16384 pixels");
  }
  if (!(s.distance > s.ball_diameter / 2)) {
    return fail("the camera is inside of the ball: distance counts to the ball's centre");
  }
  if (!(s.target_distance > s.ball_diameter / 2)) {
    return fail("the target is inside of the ball: its distance counts from the ball's centre");
  }
  if (!(s.distance - s.ball_diameter / 2 > 2 * s.focal_length)) {
    return fail("the ball is nearer than twice the focal length; no usual lens focuses there");
  }
  return {};
}

/// Formats the numbers like printf.
template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  std::array<char, 200> line;
  std::snprintf(line.data(), line.size(), format, numbers...);
  return line.data();
}

/// The nearest and the farthest point that must be sharp, mm from the camera.
struct Depth {
  double near, far;
};

/// Distances of the limb and of the target's mirror image in the middle of the ball. A convex
/// mirror of radius R shows a point at u before it at u R / (2 u + R) behind it.
Depth depth_of(const Arrangement& s) {
  const double radius = s.ball_diameter / 2, before = s.target_distance - radius;
  const double image = before * radius / (2 * before + radius);
  const double limb = s.distance - radius * radius / s.distance;
  const double middle = s.distance - radius + image;
  return {std::min(middle, limb), std::max(middle, limb)};
}

/// The focused lens's focal length in pixels: image distance over pixel pitch.
double focal_pixels(const Arrangement& s, double focus) {
  return s.focal_length * focus / (focus - s.focal_length) / (s.pixel * 1e-3);
}

/// A camera on -Y of the ball that looks at it, with a room at the target's distance.
Result<optics::BallProjection> projection(const Arrangement& s, double focal,
                                          optics::Scene::Room room) {
  const optics::Ball ball{{}, s.ball_diameter / 2};
  const auto lens = optics::Lens::make({s.sensor_width, s.sensor_height, focal, focal,
                                        (s.sensor_width - 1) / 2.0, (s.sensor_height - 1) / 2.0});
  if (!lens) return tl::unexpected(lens.error());
  optics::Scene scene;
  scene.room = room;
  scene.radius = s.target_distance;
  const auto proxy = optics::SceneProxy::make(scene, ball);
  if (!proxy) return tl::unexpected(proxy.error());
  const optics::Pose pose{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {0, -s.distance, 0}};
  return optics::BallProjection::make(optics::BallModel::Kind::Exact, {*lens, pose, std::nullopt},
                                      ball, *proxy);
}

Result<std::vector<TargetSight>> sights(const Arrangement& s, double focal) {
  const auto near = projection(s, focal, optics::Scene::Room::Sphere);
  if (!near) return tl::unexpected(near.error());
  const auto far = projection(s, focal, optics::Scene::Room::None);
  if (!far) return tl::unexpected(far.error());
  std::vector<TargetSight> all;
  for (const double phi : kAngles) {
    const double angle = optics::radians(phi);
    const Vec3 direction{std::sin(angle), -std::cos(angle), 0};
    const double resolution = optics::resolution(*near, direction);
    const auto pixel = near->pixel(direction);
    if (!pixel || !(resolution > 0)) continue;
    const auto taken_for = far->direction(*pixel);
    const double per_mm = resolution / (s.target_distance * optics::radians(1));
    all.push_back({phi, resolution, per_mm, kMeasuredPixels / per_mm,
                   taken_for ? optics::degrees(optics::angle_between(*taken_for, direction)) : 0});
  }
  return all;
}

std::string lens_advice(const Arrangement& s, const Advice& a) {
  const double longer = kGoodFill / a.fill;
  if (a.fill > 1) {
    return text("the ball is larger than the picture: take a lens of %.0f mm or less",
                s.focal_length * longer);
  }
  if (a.fill >= kPoorFill) return {};
  return text(
      "the ball fills %.0f %% of the picture's short side: a lens of %.0f mm "
      "shows %.1f times as much",
      100 * a.fill, s.focal_length * longer, longer);
}

std::string place_advice(const Arrangement& s, const Advice& a) {
  const auto [best, worst] = std::ranges::minmax_element(a.sights, {}, &TargetSight::smallest);
  const bool is_one_sided = s.smallest && worst != a.sights.end() &&
                            worst->smallest > *s.smallest && best->smallest <= *s.smallest;
  if (!is_one_sided) return {};
  return text(
      "%.2f mm can be measured where the camera sees it well only: place the "
      "camera on the target's side of the ball",
      *s.smallest);
}

/// Advice on the number of pixels with the lens of lens_advice().
std::string pixel_advice(const Arrangement& s, const Advice& a) {
  const auto worst = std::ranges::max_element(a.sights, {}, &TargetSight::smallest);
  if (!s.smallest || worst == a.sights.end()) return {};
  const bool has_other_lens = a.fill < kPoorFill || a.fill > 1;
  const double factor = worst->smallest / *s.smallest * (has_other_lens ? a.fill / kGoodFill : 1);
  if (!(worst->smallest > *s.smallest && factor > 1)) return {};
  std::string advice = text("%.2f mm in every direction needs %.1f times as many pixels across",
                            *s.smallest, factor);
  const double nearer = s.target_distance / factor;
  if (nearer > s.ball_diameter) advice += text(", or the ball %.0f mm from the target", nearer);
  return advice;
}

std::string aperture_advice(const Arrangement&, const Advice& a) {
  if (a.f_number > a.diffraction_f_number) {
    return text(
        "f/%.1f is needed for the depth of field, but diffraction blurs from f/%.1f "
        "on: take a smaller ball, more distance or larger pixels",
        a.f_number, a.diffraction_f_number);
  }
  if (!(a.f_number > kDarkFNumber)) return {};
  return text("f/%.0f lets little light through: light the machine, or take a smaller ball",
              a.f_number);
}

std::vector<std::string> changes(const Arrangement& s, const Advice& a) {
  std::vector<std::string> all;
  for (const auto& advise_on : {lens_advice, place_advice, pixel_advice, aperture_advice}) {
    if (std::string advice = advise_on(s, a); !advice.empty()) all.push_back(std::move(advice));
  }
  return all;
}

}  // namespace

Result<Advice> advise(const Arrangement& arrangement) {
  if (const auto checked = check(arrangement); !checked) return tl::unexpected(checked.error());
  Advice a;
  const double psi = std::asin(arrangement.ball_diameter / 2 / arrangement.distance);
  a.alpha = 360 - 2 * optics::degrees(psi);
  const auto [near, far] = depth_of(arrangement);
  a.depth_of_field = far - near;
  a.focus = 2 * near * far / (near + far);
  const double focal = focal_pixels(arrangement, a.focus);
  a.ball_pixels = focal * std::tan(psi);
  a.fill = 2 * a.ball_pixels / std::min(arrangement.sensor_width, arrangement.sensor_height);
  const double f = arrangement.focal_length, pixel = arrangement.pixel * 1e-3;
  a.f_number = f * f * (1 / near - 1 / far) / 2 * a.focus / (a.focus - f) / pixel;
  a.diffraction_f_number = kAiryPixels * pixel / (2.44 * kWavelength);
  auto seen = sights(arrangement, focal);
  if (!seen) return tl::unexpected(seen.error());
  a.sights = std::move(*seen);
  a.changes = changes(arrangement, a);
  return a;
}

}  // namespace orbwatch::align
