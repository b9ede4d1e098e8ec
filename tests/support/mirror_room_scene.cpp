// SPDX-License-Identifier: Apache-2.0
#include "tests/support/mirror_room_scene.h"

#include <algorithm>
#include <cmath>

#include "app/simulation/scene/hash.h"

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
using Light = MirrorRoomScene::Light;

Light product(const Light& a, const Light& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

/// The point's two coordinates on a face perpendicular to `axis`.
Vec2 on_face(const Vec3& p, int axis) {
  return axis == 0 ? Vec2{p.y, p.z} : axis == 1 ? Vec2{p.x, p.z} : Vec2{p.x, p.y};
}

}  // namespace

MirrorRoomScene::Paint MirrorRoomScene::Paint::warmed() const {
  Paint paint = *this;
  paint.warm = true;
  const double warmth = 0.05 + 0.6 * uniform(seed, 0, 20);
  paint.base = {warmth, warmth, warmth};
  paint.stains = 0.3 * stains * uniform(seed, 0, 21);
  return paint;
}

Light MirrorRoomScene::Paint::at(double x, double y) const {
  Light light = base;
  const auto cell = [this](double a, double b, std::uint64_t channel) {
    const auto i = static_cast<std::int64_t>(std::floor(a));
    const auto j = static_cast<std::int64_t>(std::floor(b));
    return uniform(seed, mix(static_cast<std::uint64_t>(i)) ^ static_cast<std::uint64_t>(j),
                   channel);
  };
  const bool patched = cell(x / patch, y / patch, 0) < strength;
  if (patched && warm) {
    if (cell(x / patch, y / patch, 22) < 0.5) light = light * (2 * cell(x / patch, y / patch, 23));
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

double MirrorRoomScene::distance_to(const Tube& tube, const Ray& ray) {
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

MirrorRoomScene::MirrorRoomScene(const MirrorRoomSettings& settings) : random_(mix(settings.seed)) {
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
    const Vec3 axis = normalized(Vec3{in(-0.2, 0.2), in(-0.2, 0.2), 1});
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

void MirrorRoomScene::hang(const Vec3& axis, double radius) {
  rod_ = Tube{axis * 0.2, axis, radius, 60, a_paint(radius * 2)};
}

void MirrorRoomScene::clear_sight(const Vec3& from) {
  const Vec3 towards = normalized(-from);
  const Vec3 side = normalized(cross(towards, {0.1, 0.3, 1})), other = cross(towards, side);
  for (int i = 0; i < 200; ++i) {
    const double turn = 2.4 * i, away = 1.02 * std::sqrt((i + 0.5) / 200);
    const Vec3 goal = (side * std::cos(turn) + other * std::sin(turn)) * away;
    const Ray ray{from, normalized(goal - from)};
    const double limit = norm(from);
    std::erase_if(blocks_, [&](const Block& b) { return entry(ray, b.box).distance < limit; });
    std::erase_if(tubes_, [&](const Tube& t) { return distance_to(t, ray) < limit; });
    std::erase_if(marbles_, [&](const Marble& m) { return entry(ray, m.sphere) < limit; });
  }
}

void MirrorRoomScene::warm() {
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

void MirrorRoomScene::stand_table(std::uint64_t seed) {
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

std::optional<optics::Box> MirrorRoomScene::table() const {
  const bool stands = table_ && std::ranges::any_of(blocks_, [this](const Block& b) {
                        return norm(b.box.lo - table_->lo) + norm(b.box.hi - table_->hi) == 0;
                      });
  if (!stands) return std::nullopt;
  return optics::Box{table_->lo, table_->hi};
}

optics::Scene MirrorRoomScene::scene() const {
  optics::Scene scene;
  scene.room = optics::Scene::Room::Box;
  scene.walls = {room_.lo, room_.hi};
  for (const Block& block : blocks_) scene.obstacles.push_back({block.box.lo, block.box.hi});
  return scene;
}

std::optional<Vec3> MirrorRoomScene::mirrored(const Ray& ray) const {
  const double hit = entry(ray, *ball_);
  if (hit == kNever || hit > end(ray).distance) return std::nullopt;
  const Vec3 normal = ray.at(hit);
  const Ray onward{normal, ray.direction - normal * (2 * dot(ray.direction, normal))};
  return onward.at(end(onward).distance);
}

Light MirrorRoomScene::light(const Ray& ray) const {
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

double MirrorRoomScene::in(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_);
}

Vec3 MirrorRoomScene::away_from_ball() {
  for (;;) {
    const Vec3 p{in(room_.lo.x, room_.hi.x), in(room_.lo.y, room_.hi.y),
                 in(room_.lo.z, room_.hi.z)};
    if (norm(p) > 2.5) return p;
  }
}

MirrorRoomScene::Paint MirrorRoomScene::a_paint(double size) {
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

MirrorRoomScene::End MirrorRoomScene::end(const Ray& ray) const {
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

void MirrorRoomScene::take_tube(const Ray& ray, const Tube& tube, End& nearest) {
  const double hit = distance_to(tube, ray);
  if (hit >= nearest.distance) return;
  const Vec3 p = ray.at(hit) - tube.foot;
  const double along = dot(p, tube.axis);
  const Vec3 normal = (p - tube.axis * along) * (1 / tube.radius);
  nearest = {hit, tube.paint.at(std::atan2(normal.y, normal.x) * tube.radius, along) *
                      (0.6 + 0.4 * std::abs(normal.x))};
}

}  // namespace orbwatch::tests
