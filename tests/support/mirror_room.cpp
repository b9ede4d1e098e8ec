// SPDX-License-Identifier: Apache-2.0
#include "tests/support/mirror_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>

#include "app/simulation/scene/hash.h"
#include "app/simulation/tracing/ray.h"

namespace orbwatch::tests {
namespace {

using app::simulation::Box;
using app::simulation::entry;
using app::simulation::FaceHit;
using app::simulation::kNever;
using app::simulation::mix;
using app::simulation::Ray;
using app::simulation::Sphere;
using app::simulation::uniform;
using optics::normalized;
using optics::Vec2;
using optics::Vec3;

/// Linear light; a thermal camera uses the first component.
using Light = Vec3;

Light product(const Light& a, const Light& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

/// Appearance of a surface: patches of random colours, stripes and stains.
struct Paint {
  std::uint64_t seed = 0;
  Light base;
  double patch = 1;     ///< side of the patches' squares
  double strength = 0;  ///< contrast of patches
  double stripes = 0;   ///< period; 0: none
  double stains = 0;    ///< amplitude of smooth noise
  bool warm = false;    ///< appearance by temperature: the same shapes, other values

  /// The same surface's appearance to a thermal camera.
  Paint warmed() const {
    Paint paint = *this;
    paint.warm = true;
    const double warmth = 0.05 + 0.6 * uniform(seed, 0, 20);
    paint.base = {warmth, warmth, warmth};
    paint.stains = 0.3 * stains * uniform(seed, 0, 21);
    return paint;
  }

  Light at(double x, double y) const {
    Light light = base;
    const auto cell = [this](double a, double b, std::uint64_t channel) {
      const auto i = static_cast<std::int64_t>(std::floor(a));
      const auto j = static_cast<std::int64_t>(std::floor(b));
      return uniform(seed, mix(static_cast<std::uint64_t>(i)) ^ static_cast<std::uint64_t>(j),
                     channel);
    };
    const bool patched = cell(x / patch, y / patch, 0) < strength;
    if (patched && warm) {
      if (cell(x / patch, y / patch, 22) < 0.5)
        light = light * (2 * cell(x / patch, y / patch, 23));
    } else if (patched) {
      light = {cell(x / patch, y / patch, 1), cell(x / patch, y / patch, 2),
               cell(x / patch, y / patch, 3)};
    }
    if (stripes > 0 && x / stripes - std::floor(x / stripes) < 0.2) {
      light = light * (warm ? 0.9 : 0.3);
    }
    double stain = 0;
    for (int octave = 0; octave < 4 && stains > 0; ++octave) {
      const double scale = patch * std::ldexp(0.7, -octave);
      const double u = x / scale, v = y / scale, fu = u - std::floor(u), fv = v - std::floor(v);
      const auto channel = static_cast<std::uint64_t>(4 + octave);
      const double top = std::lerp(cell(u, v, channel), cell(u + 1, v, channel), fu);
      const double bottom = std::lerp(cell(u, v + 1, channel), cell(u + 1, v + 1, channel), fu);
      stain += (std::lerp(top, bottom, fv) - 0.5) * std::ldexp(1.0, -octave);
    }
    return light * std::max(0.05, 1 + stains * stain);
  }
};

/// A solid tube from `foot` along `axis`.
struct Tube {
  Vec3 foot;
  Vec3 axis;  ///< unit vector
  double radius = 0;
  double length = 0;
  Paint paint;
};

struct Block {
  Box box;
  std::array<Paint, 3> paints;  ///< one per axis
};

struct Marble {
  Sphere sphere;
  Paint paint;
};

/// The end of a ray.
struct End {
  double distance = kNever;
  Light light;
};

double entry(const Ray& ray, const Tube& tube) {
  const Vec3 from = ray.origin - tube.foot;
  const Vec3 d = ray.direction - tube.axis * dot(ray.direction, tube.axis);
  const Vec3 o = from - tube.axis * dot(from, tube.axis);
  const double a = dot(d, d), b = dot(o, d), c = dot(o, o) - tube.radius * tube.radius;
  const double discriminant = b * b - a * c;
  if (a < 1e-12 || discriminant <= 0 || c <= 0) return kNever;
  const double distance = (-b - std::sqrt(discriminant)) / a;
  if (distance < 0) return kNever;
  const double along = dot(from + ray.direction * distance, tube.axis);
  return along >= 0 && along <= tube.length ? distance : kNever;
}

/// The point's two coordinates on a face perpendicular to `axis`.
Vec2 on_face(const Vec3& p, int axis) {
  return axis == 0 ? Vec2{p.y, p.z} : axis == 1 ? Vec2{p.x, p.z} : Vec2{p.x, p.y};
}

class Room {
 public:
  explicit Room(const MirrorRoomSettings& settings) : random_(mix(settings.seed)) {
    const double size = std::exp(in(std::log(5.0), std::log(45.0)));
    room_ = {{-size * in(0.5, 1), -size * in(0.5, 1), -size * in(0.4, 1)},
             {size * in(0.5, 1), size * in(0.5, 1), size * in(0.4, 1)}};
    for (auto& side : walls_) {
      for (Paint& paint : side) paint = a_paint(size);
    }
    const int blocks = static_cast<int>(in(4, 25));
    for (int i = 0; i < blocks; ++i) {
      const Vec3 middle = away_from_ball(),
                 half = Vec3{in(0.02, 0.15), in(0.02, 0.15), in(0.02, 0.3)} * size;
      const Box box{middle - half, middle + half};
      const Box near{box.lo - Vec3{1.5, 1.5, 1.5}, box.hi + Vec3{1.5, 1.5, 1.5}};
      if (near.contains({})) continue;
      blocks_.push_back({box, {a_paint(size / 4), a_paint(size / 4), a_paint(size / 4)}});
    }
    for (int i = static_cast<int>(in(0, 5)); i > 0; --i) {
      const Vec3 foot = away_from_ball();
      const Vec3 axis = normalized({in(-0.2, 0.2), in(-0.2, 0.2), 1});
      if (norm(foot - axis * dot(foot, axis)) < 2.5) continue;
      tubes_.push_back({foot, axis, in(0.1, 1), in(0.2, 1) * size, a_paint(size / 4)});
    }
    for (int i = static_cast<int>(in(0, 4)); i > 0; --i) {
      const Vec3 centre = away_from_ball();
      const double radius = std::min(in(0.03, 0.12) * size, norm(centre) - 1.3);
      if (radius > 0.1) marbles_.push_back({{centre, radius}, a_paint(size / 4)});
    }
    for (int i = static_cast<int>(in(1, 5)); i > 0; --i) {
      lamps_.push_back({{in(-0.8, 0.8) * size, in(-0.8, 0.8) * size},
                        {in(0.03, 0.2) * size, in(0.03, 0.2) * size},
                        in(2, 12)});
    }
    reflectance_ = Light{in(0.6, 1), in(0.6, 1), in(0.6, 1)};
    grain_ = in(0, 1) < 0.3 ? in(0, 0.2) : 0;
    if (settings.ball) ball_ = Sphere{{}, 1};
    if (settings.table) stand_table(settings.seed);
  }

  void hang(const Vec3& axis, double radius) {
    rod_ = Tube{axis * 0.2, axis, radius, 60, a_paint(radius * 2)};
  }

  /// Removes everything that hides the ball from a point, except the rod.
  void clear_sight(const Vec3& from) {
    const Vec3 towards = normalized(-from);
    const Vec3 side = normalized(cross(towards, {0.1, 0.3, 1})), other = cross(towards, side);
    for (int i = 0; i < 200; ++i) {
      const double turn = 2.4 * i, away = 1.02 * std::sqrt((i + 0.5) / 200);
      const Vec3 goal = (side * std::cos(turn) + other * std::sin(turn)) * away;
      const Ray ray{from, normalized(goal - from)};
      const double limit = norm(from);
      std::erase_if(blocks_, [&](const Block& b) { return entry(ray, b.box).distance < limit; });
      std::erase_if(tubes_, [&](const Tube& t) { return entry(ray, t) < limit; });
      std::erase_if(marbles_, [&](const Marble& m) { return entry(ray, m.sphere) < limit; });
    }
  }

  /// Switches to temperatures.
  void warm() {
    for (auto& side : walls_) {
      for (Paint& paint : side) paint = paint.warmed();
    }
    for (Block& block : blocks_) {
      for (Paint& paint : block.paints) paint = paint.warmed();
    }
    for (Tube& tube : tubes_) tube.paint = tube.paint.warmed();
    for (Marble& marble : marbles_) marble.paint = marble.paint.warmed();
    if (rod_) rod_->paint = rod_->paint.warmed();
  }

  /// Adds a table with a seed of its own, so that everything else is the same as without it.
  void stand_table(std::uint64_t seed) {
    std::mt19937_64 random(mix(seed ^ 0x7ab1e));
    const auto any = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const Vec3 size = room_.hi - room_.lo;
    const Vec3 half{size.x * any(0.15, 0.3), size.y * any(0.15, 0.3), 0};
    const Vec3 middle{any(room_.lo.x + half.x, room_.hi.x - half.x),
                      any(room_.lo.y + half.y, room_.hi.y - half.y), 0};
    const double top = std::min(-1.6, room_.lo.z * any(0.4, 0.85));
    const double patch = norm(size) / 12;
    table_ = Box{{middle.x - half.x, middle.y - half.y, room_.lo.z},
                 {middle.x + half.x, middle.y + half.y, top}};
    blocks_.push_back({*table_, {a_paint(patch), a_paint(patch), a_paint(patch)}});
  }

  /// nullopt: there is no table, or it was removed because it hid the ball.
  std::optional<optics::Box> table() const {
    const bool stands = table_ && std::ranges::any_of(blocks_, [this](const Block& b) {
                          return norm(b.box.lo - table_->lo) + norm(b.box.hi - table_->hi) == 0;
                        });
    if (!stands) return std::nullopt;
    return optics::Box{table_->lo, table_->hi};
  }

  /// The walls and boxes.
  optics::Scene scene() const {
    optics::Scene scene;
    scene.room = optics::Scene::Room::Box;
    scene.walls = {room_.lo, room_.hi};
    for (const Block& block : blocks_) scene.obstacles.push_back({block.box.lo, block.box.hi});
    return scene;
  }

  /// The point where a ray reflected by the ball ends.
  std::optional<Vec3> mirrored(const Ray& ray) const {
    const double hit = entry(ray, *ball_);
    if (hit == kNever || hit > end(ray).distance) return std::nullopt;
    const Vec3 normal = ray.at(hit);
    const Ray onward{normal, ray.direction - normal * (2 * dot(ray.direction, normal))};
    return onward.at(end(onward).distance);
  }

  /// The light that arrives along a ray from outside of everything.
  Light light(const Ray& ray) const {
    const End direct = end(ray);
    if (!ball_) return direct.light;
    const double hit = entry(ray, *ball_);
    if (hit > direct.distance || hit == kNever) return direct.light;
    const Vec3 normal = ray.at(hit);
    const double cosine = -dot(ray.direction, normal);
    const Ray mirrored{normal, ray.direction + normal * (2 * cosine)};
    const double grazing = std::pow(1 - cosine, 5);
    const Light share = reflectance_ * (1 - grazing) + Light{1, 1, 1} * grazing;
    return product(end(mirrored).light, share) * (1 - grain_) +
           product(share, {0.3, 0.3, 0.3}) * grain_;
  }

 private:
  struct Lamp {
    Vec2 centre;
    Vec2 half;
    double light;
  };

  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  Vec3 away_from_ball() {
    for (;;) {
      const Vec3 p{in(room_.lo.x, room_.hi.x), in(room_.lo.y, room_.hi.y),
                   in(room_.lo.z, room_.hi.z)};
      if (norm(p) > 2.5) return p;
    }
  }

  Paint a_paint(double size) {
    Paint paint;
    paint.seed = random_();
    const double brightness = in(0.05, 0.8), tint = in(0, 0.4);
    paint.base = Light{brightness * in(1 - tint, 1), brightness * in(1 - tint, 1),
                       brightness * in(1 - tint, 1)};
    paint.patch = size * std::exp(in(std::log(0.03), std::log(0.3)));
    paint.strength = in(0, 1) < 0.7 ? in(0, 0.5) : 0;
    paint.stripes = in(0, 1) < 0.3 ? size * in(0.02, 0.2) : 0;
    paint.stains = in(0, 1) < 0.8 ? in(0.05, 0.8) : 0;
    return paint;
  }

  /// The first surface other than the ball's.
  End end(const Ray& ray) const {
    End nearest;
    const auto passage = app::simulation::passage(ray, room_);
    if (!passage.misses()) {
      const FaceHit wall = passage.out;
      const Vec3 p = ray.at(wall.distance);
      const Vec2 place = on_face(p, wall.axis);
      const bool high = (wall.axis == 0   ? ray.direction.x
                         : wall.axis == 1 ? ray.direction.y
                                          : ray.direction.z) > 0;
      nearest = {wall.distance,
                 walls_[high ? 1 : 0][static_cast<std::size_t>(wall.axis)].at(place.u, place.v)};
      if (wall.axis == 2 && high) {
        for (const Lamp& lamp : lamps_) {
          if (std::abs(place.u - lamp.centre.u) < lamp.half.u &&
              std::abs(place.v - lamp.centre.v) < lamp.half.v) {
            nearest.light = Light{1, 1, 0.9} * lamp.light;
          }
        }
      }
    }
    for (const Block& block : blocks_) {
      const FaceHit hit = entry(ray, block.box);
      if (hit.distance >= nearest.distance) continue;
      const Vec2 place = on_face(ray.at(hit.distance), hit.axis);
      const auto axis = static_cast<std::size_t>(hit.axis);
      nearest = {hit.distance, block.paints[axis].at(place.u, place.v) * (1 - 0.2 * hit.axis)};
    }
    for (const Tube& tube : tubes_) take_tube(ray, tube, nearest);
    if (rod_) take_tube(ray, *rod_, nearest);
    for (const Marble& marble : marbles_) {
      const double hit = entry(ray, marble.sphere);
      if (hit >= nearest.distance) continue;
      const Vec3 p = ray.at(hit), normal = (p - marble.sphere.centre) * (1 / marble.sphere.radius);
      nearest = {hit, marble.paint.at(std::atan2(p.y, p.x) * 3, p.z) * (0.6 + 0.4 * normal.z)};
    }
    return nearest;
  }

  static void take_tube(const Ray& ray, const Tube& tube, End& nearest) {
    const double hit = entry(ray, tube);
    if (hit >= nearest.distance) return;
    const Vec3 p = ray.at(hit) - tube.foot;
    const double along = dot(p, tube.axis);
    const Vec3 normal = (p - tube.axis * along) * (1 / tube.radius);
    nearest = {hit, tube.paint.at(std::atan2(normal.y, normal.x) * tube.radius, along) *
                        (0.6 + 0.4 * std::abs(normal.x))};
  }

  std::mt19937_64 random_;
  Box room_;
  std::array<std::array<Paint, 3>, 2> walls_;  ///< low and high sides, for each axis
  std::vector<Block> blocks_;
  std::vector<Tube> tubes_;
  std::vector<Marble> marbles_;
  std::vector<Lamp> lamps_;
  std::optional<Sphere> ball_;
  std::optional<Box> table_;
  std::optional<Tube> rod_;
  Light reflectance_;
  double grain_ = 0;  ///< share of light that the ball scatters
};

/// A camera's axes in the room, rows right, down, forward, its position and its focal length.
struct Camera {
  optics::Mat3 axes;
  Vec3 position;
  double focal_length = 0;

  Ray ray(double u, double v, const cv::Size& size) const {
    const Vec3 w{(u - (size.width - 1) * 0.5) / focal_length,
                 (v - (size.height - 1) * 0.5) / focal_length, 1};
    return {position, normalized(transposed(axes) * w)};
  }
};

Camera camera_of(const MirrorRoomSettings& s, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Camera camera;
  camera.focal_length = s.radius * std::sqrt(s.distance * s.distance - 1);
  const Vec3 forward = normalized({unit(random), unit(random), unit(random) * 0.4});
  const double roll = unit(random) * 0.3;
  const Vec3 level = normalized(cross(forward, {0, 0, 1})), down = cross(forward, level);
  camera.axes = {level * std::cos(roll) + down * std::sin(roll),
                 down * std::cos(roll) - level * std::sin(roll), forward};
  const Vec3 towards = normalized({s.off_axis.u * s.width / 2 / camera.focal_length,
                                   s.off_axis.v * s.height / 2 / camera.focal_length, 1});
  camera.position = -(transposed(camera.axes) * (towards * s.distance));
  return camera;
}

/// The limb of a unit sphere at `c` in the camera frame: rays w with (w.c)^2 = |w|^2 (c.c - 1).
TrueLimb limb_of(const Vec3& c, double focal_length, const cv::Size& size) {
  const double k = dot(c, c) - 1;
  const double xx = c.x * c.x - k, yy = c.y * c.y - k, zz = c.z * c.z - k;
  const double xy = c.x * c.y, xz = c.x * c.z, yz = c.y * c.z;
  const double determinant = xx * yy - xy * xy;
  const double u = (xy * yz - yy * xz) / determinant, v = (xy * xz - xx * yz) / determinant;
  const double level = -(zz + xz * u + yz * v);
  const double mean = (xx + yy) / 2, half = std::hypot((xx - yy) / 2, xy);
  return {{u * focal_length + (size.width - 1) * 0.5, v * focal_length + (size.height - 1) * 0.5},
          std::sqrt(level / (mean + half)) * focal_length,
          std::sqrt(level / (mean - half)) * focal_length};
}

cv::Mat encode(const cv::Mat& light, const MirrorRoomSettings& s, std::mt19937_64& random) {
  cv::Mat seen;
  cv::GaussianBlur(light, seen, {}, std::max(s.blur, 0.3));
  std::normal_distribution<float> normal;
  const auto noise = [&](std::mt19937_64& from) {
    return static_cast<float>(s.noise) * normal(from);
  };
  if (s.thermal) {
    cv::Mat counts(seen.size(), CV_16UC1);
    for (int v = 0; v < seen.rows; ++v) {
      for (int u = 0; u < seen.cols; ++u) {
        const float kelvin = 291 + 22 * std::min(seen.at<cv::Vec3f>(v, u)[0], 6.F);
        counts.at<std::uint16_t>(v, u) =
            cv::saturate_cast<std::uint16_t>(kelvin * 25 + noise(random));
      }
    }
    return counts;
  }
  cv::Mat samples(seen.size(), CV_8UC3);
  std::vector<float> greens;
  for (int v = 0; v < seen.rows; v += 4) {
    for (int u = 0; u < seen.cols; u += 4) greens.push_back(seen.at<cv::Vec3f>(v, u)[1]);
  }
  const auto median = greens.begin() + static_cast<std::ptrdiff_t>(greens.size() / 2);
  std::nth_element(greens.begin(), median, greens.end());
  const float gain = 0.2F / std::max(*median, 1e-3F) * static_cast<float>(std::exp2(s.exposure));
  for (int v = 0; v < seen.rows; ++v) {
    for (int u = 0; u < seen.cols; ++u) {
      for (int c = 0; c < 3; ++c) {
        const float x = std::clamp(seen.at<cv::Vec3f>(v, u)[2 - c] * gain, 0.F, 1.F);
        const float y = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
        samples.at<cv::Vec3b>(v, u)[c] = cv::saturate_cast<std::uint8_t>(y * 255 + noise(random));
      }
    }
  }
  return samples;
}

/// Adds the rod that the ball hangs on, across the line of sight, so that it hides a share of the
/// limb's angles.
void hang(Room& room, const Camera& camera, const MirrorRoomSettings& settings,
          std::mt19937_64& random) {
  if (!(settings.limb_hidden > 0)) return;
  const double angle = std::uniform_real_distribution<double>(0, 6.28)(random);
  const Vec3 towards = normalized(camera.position);
  const Vec3 side = normalized(cross(towards, {0.1, 0.3, 1})), other = cross(towards, side);
  room.hang(side * std::cos(angle) + other * std::sin(angle),
            std::sin(std::numbers::pi * std::min(settings.limb_hidden, 0.45)));
}

/// Traces the camera's picture; pixels near the limb by 4x4 rays.
MirrorRoomPicture picture(const Room& room, const Camera& camera,
                          const MirrorRoomSettings& settings, std::mt19937_64& random) {
  const cv::Size size(settings.width, settings.height);
  cv::Mat light(size, CV_32FC3);
  const double limb = std::sqrt(1 - 1 / (settings.distance * settings.distance));
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const Ray ray = camera.ray(u, v, size);
      // Parts of the ball where few pixels show much, and the surroundings of its limb.
      const double cosine = -dot(ray.direction, normalized(camera.position));
      const double rho =
          std::tan(std::acos(std::min(1.0, cosine))) / std::sqrt(1 / (limb * limb) - 1);
      const bool inside = settings.ball && rho > 0.7 && rho < 1 + 4 / settings.radius;
      const bool limb_near = inside && rho > 1 - 4 / settings.radius;
      const int side = limb_near ? 4 : inside ? 2 : 1;
      Light sum;
      for (int i = 0; i < side * side; ++i) {
        sum = sum + (side > 1 ? room.light(camera.ray(u + (i % side + 0.5) / side - 0.5,
                                                      v + (i / side + 0.5) / side - 0.5, size))
                              : room.light(ray));
      }
      sum = sum * (1.0 / (side * side));
      light.at<cv::Vec3f>(v, u) = {static_cast<float>(std::min(sum.x, 20.0)),
                                   static_cast<float>(std::min(sum.y, 20.0)),
                                   static_cast<float>(std::min(sum.z, 20.0))};
    }
  }
  const Vec3 ball = camera.axes * -camera.position;
  return {encode(light, settings, random),
          limb_of(ball, camera.focal_length, size),
          camera.focal_length,
          ball,
          camera.axes,
          camera.position,
          {}};
}

}  // namespace

double share_outside(const MirrorRoomSettings& s) {
  constexpr int kPoints = 360;
  int outside = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints;
    const double u = s.off_axis.u * s.width / 2 + s.radius * std::cos(angle);
    const double v = s.off_axis.v * s.height / 2 + s.radius * std::sin(angle);
    outside += std::abs(u) > s.width / 2.0 || std::abs(v) > s.height / 2.0 ? 1 : 0;
  }
  return static_cast<double>(outside) / kPoints;
}

MirrorRoomPicture mirror_room(const MirrorRoomSettings& settings) {
  std::mt19937_64 random(mix(settings.seed ^ 0x5eed));
  Room room(settings);
  const Camera camera = camera_of(settings, random);
  room.clear_sight(camera.position);
  hang(room, camera, settings, random);
  return picture(room, camera, settings, random);
}

MirrorRoomPair mirror_room_pair(const MirrorRoomSettings& first, const MirrorRoomSettings& second) {
  std::mt19937_64 random(mix(first.seed ^ 0x5eed));
  Room room(first);
  const Camera a = camera_of(first, random);
  Camera b = camera_of(second, random);
  const auto apart = [&] { return angle_between(a.position, b.position); };
  while (apart() < optics::radians(30) || apart() > optics::radians(150)) {
    b = camera_of(second, random);
  }
  room.clear_sight(a.position);
  room.clear_sight(b.position);
  hang(room, a, first, random);
  const auto seen = [&](const Camera& camera, const MirrorRoomSettings& settings) {
    Room shown = room;
    if (settings.thermal) shown.warm();
    MirrorRoomPicture taken = picture(shown, camera, settings, random);
    const cv::Size size(settings.width, settings.height);
    taken.mirrored = [room, camera, size](const Vec2& pixel) {
      return room.mirrored(camera.ray(pixel.u, pixel.v, size));
    };
    return taken;
  };
  const MirrorRoomPicture from_a = seen(a, first), from_b = seen(b, second);
  return {from_a, from_b, room.scene(), room.table()};
}

}  // namespace orbwatch::tests
