// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/scene_proxy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace orbwatch::optics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Limit in ball radii. Everything further has no parallax in double precision; squares stay finite.
constexpr double kLargestCoordinate = 1e9;

constexpr int kWalls = 6;
constexpr int kFaces = 6;

using Axes = std::array<double, 3>;

Axes by_axis(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 vector(const Axes& v) { return {v[0], v[1], v[2]}; }

bool is_usable(const Vec3& v) {
  return std::abs(v.x) <= kLargestCoordinate && std::abs(v.y) <= kLargestCoordinate &&
         std::abs(v.z) <= kLargestCoordinate;
}

Result<> check_numbers(const std::string& part, bool usable) {
  if (usable) return {};
  return fail(part + ": its numbers must be finite and within 1e9 ball radii");
}

Result<> check_box(const std::string& part, const Box& box) {
  if (auto numbers = check_numbers(part, is_usable(box.low) && is_usable(box.high)); !numbers) {
    return numbers;
  }
  const Vec3 size = box.high - box.low;
  if (size.x > 0 && size.y > 0 && size.z > 0) return {};
  return fail(part + ": low must be below high on every axis");
}

// Distance from the ball's centre to the nearest point of a box; 0 within it.
double distance_to(const Box& box) {
  const auto outside = [](double low, double high) { return std::max({low, 0.0, -high}); };
  return norm({outside(box.low.x, box.high.x), outside(box.low.y, box.high.y),
               outside(box.low.z, box.high.z)});
}

// Distance from the ball's centre within a box to the nearest wall; below 0 outside.
double clearance_within(const Box& box) {
  const Vec3 &low = box.low, &high = box.high;
  return std::min({-low.x, high.x, -low.y, high.y, -low.z, high.z});
}

/// `nearest`: distance of the part's surface from the ball's centre.
Result<> check_room(const std::string& part, bool centre_is_inside, double nearest) {
  if (!(nearest > 1)) return fail(part + " cuts the ball");
  if (!centre_is_inside) return fail(part + " does not enclose the ball");
  return {};
}

Result<> check_obstacle(const std::string& part, const Box& box) {
  if (auto good = check_box(part, box); !good) return good;
  if (clearance_within(box) >= 1) return fail(part + " contains the ball");
  if (!(distance_to(box) > 1)) return fail(part + " cuts the ball");
  return {};
}

// Index of a box's side, 0 to 5: low x, high x, low y...
int face(std::size_t axis, bool high) { return 2 * static_cast<int>(axis) + (high ? 1 : 0); }

/// Calls `edge(corner, axis)` for the twelve edges: bit n of a corner is set at the high end of
/// axis n; the edge runs from there along `axis`.
template <class Edge>
void for_each_edge(const Edge& edge) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (!(corner >> axis & 1U)) edge(corner, axis);
    }
  }
}

std::pair<Vec3, Vec3> ends(const Axes& low, const Axes& high, unsigned corner, unsigned axis) {
  const auto at = [&](unsigned c) {
    return Vec3{(c & 1U ? high : low)[0], (c & 2U ? high : low)[1], (c & 4U ? high : low)[2]};
  };
  return {at(corner), at(corner | 1U << axis)};
}

/// True if one of the faces that meet in the edge is turned towards the ball; else the box hides
/// the edge.
bool faces_ball(const Axes& low, const Axes& high, unsigned corner, unsigned axis) {
  for (unsigned other = 0; other < 3; ++other) {
    if (other == axis) continue;
    if (corner >> other & 1U ? high[other] < 0 : low[other] > 0) return true;
  }
  return false;
}

/// One of a box's faces.
SceneProxy::Face side(const Box& box, std::size_t axis, bool is_high, int surface) {
  const Axes low = by_axis(box.low), high = by_axis(box.high);
  const std::size_t first = (axis + 1) % 3, second = (axis + 2) % 3;
  Axes corner = low, along{}, across{};
  corner[axis] = (is_high ? high : low)[axis];
  along[first] = high[first] - low[first];
  across[second] = high[second] - low[second];
  return {vector(corner), vector(along), vector(across), surface};
}

/// The box slightly enlarged except along `axis`, so that no gap shows where its faces meet.
Box grown(const Axes& low, const Axes& high, std::size_t axis) {
  constexpr double kShare = 1e-3;
  Axes from = low, to = high;
  for (std::size_t other = 0; other < 3; ++other) {
    if (other == axis) continue;
    const double more = (high[other] - low[other]) * kShare;
    from[other] -= more;
    to[other] += more;
  }
  return {vector(from), vector(to)};
}

}  // namespace

SceneProxy::Block::Block(const Box& box) : low(by_axis(box.low)), high(by_axis(box.high)) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    inverse_low[axis] = 1 / low[axis];
    inverse_high[axis] = 1 / high[axis];
  }
}

double SceneProxy::Block::closeness(int face, const Vec3& direction) const {
  const auto axis = static_cast<std::size_t>(face / 2);
  return by_axis(direction)[axis] * (face % 2 ? inverse_high[axis] : inverse_low[axis]);
}

Result<SceneProxy> SceneProxy::make(const Scene& scene, const Ball& ball) {
  if (auto good = check_ball(ball); !good) return tl::unexpected(good.error());
  const auto relative = [&](const Vec3& p) { return (p - ball.centre) * (1 / ball.radius); };
  const auto relative_box = [&](const Box& b) { return Box{relative(b.low), relative(b.high)}; };
  SceneProxy proxy;
  proxy.room_ = scene.room;
  Result<> room;
  if (scene.room == Scene::Room::Sphere) {
    room = proxy.set_sphere(relative(scene.centre), scene.radius / ball.radius);
  } else if (scene.room == Scene::Room::Plane) {
    room = proxy.set_plane(relative(scene.point), scene.normal);
  } else if (scene.room == Scene::Room::Box) {
    room = proxy.set_walls(relative_box(scene.walls));
  }
  if (!room) return tl::unexpected(room.error());
  for (const Box& box : scene.obstacles) {
    const Box obstacle = relative_box(box);
    const std::string part = "obstacle " + std::to_string(proxy.obstacles_.size() + 1);
    if (auto good = check_obstacle(part, obstacle); !good) return tl::unexpected(good.error());
    proxy.obstacles_.emplace_back(obstacle);
  }
  return proxy;
}

Result<> SceneProxy::set_sphere(const Vec3& centre, double radius) {
  const std::string part = "the room's sphere";
  const bool usable = is_usable(centre) && std::abs(radius) <= kLargestCoordinate;
  if (auto numbers = check_numbers(part, usable); !numbers) return numbers;
  if (!(radius > 0)) return fail(part + ": its radius must be above 0");
  centre_ = centre;
  radius_ = radius;
  return check_room(part, norm(centre) < radius, std::abs(radius - norm(centre)));
}

Result<> SceneProxy::set_plane(const Vec3& point, const Vec3& normal) {
  const std::string part = "the room's plane";
  if (auto numbers = check_numbers(part, is_usable(point)); !numbers) return numbers;
  const double length = norm(normal);
  if (!(length > 0) || !std::isfinite(length)) {
    return fail(part + ": its normal must be a direction: finite, and not 0");
  }
  const double offset = dot(point, normal) / length;
  plane_ = normal * (1 / (length * offset));
  return check_room(part, true, std::abs(offset));
}

Result<> SceneProxy::set_walls(const Box& walls) {
  const std::string part = "the room's box";
  if (auto good = check_box(part, walls); !good) return good;
  walls_ = Block(walls);
  const double clearance = clearance_within(walls);
  return check_room(part, clearance > 0, clearance > 0 ? clearance : distance_to(walls));
}

SceneProxy::Hit SceneProxy::hit(const Vec3& direction) const {
  Hit hit = hit_room(direction);
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const Hit obstacle = hit_obstacle(obstacles_[i], direction);
    if (obstacle.closeness > hit.closeness) {
      hit = {obstacle.closeness, obstacle.surface + kWalls + kFaces * static_cast<int>(i)};
    }
  }
  return hit;
}

SceneProxy::Hit SceneProxy::hit_room(const Vec3& direction) const {
  switch (room_) {
    case Scene::Room::None:
      return {};
    case Scene::Room::Sphere: {
      // L^2 - 2 L c.v = r^2 - |c|^2
      const double along = dot(centre_, direction);
      const double power = radius_ * radius_ - dot(centre_, centre_);
      const double root = std::sqrt(along * along + power);
      return {(root - along) / power, 0};
    }
    case Scene::Room::Plane: {
      const double closeness = dot(plane_, direction);
      return closeness > 0 ? Hit{closeness, 0} : Hit{};
    }
    case Scene::Room::Box:
      return hit_walls(direction);
  }
  return {};
}

// The first wall met is the one with the greatest closeness, v / wall: a maximum, which every
// direction has.
SceneProxy::Hit SceneProxy::hit_walls(const Vec3& direction) const {
  Hit hit;
  const auto v = by_axis(direction);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool up = v[axis] > 0;
    const double closeness = v[axis] * (up ? walls_.inverse_high[axis] : walls_.inverse_low[axis]);
    if (closeness > hit.closeness) hit = {closeness, face(axis, up)};
  }
  return hit;
}

// The ray at closeness s is within the box where low s <= v <= high s on every axis: the faces
// turned towards the ball bound s from above, the others from below.
SceneProxy::Hit SceneProxy::hit_obstacle(const Block& box, const Vec3& direction) {
  const auto v = by_axis(direction);
  Hit entry{kInfinity, -1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool low = box.low[axis] > 0;
    if (!low && !(box.high[axis] < 0)) continue;
    const double closeness = v[axis] * (low ? box.inverse_low[axis] : box.inverse_high[axis]);
    if (closeness < entry.closeness) entry = {closeness, face(axis, !low)};
  }
  if (!(entry.closeness > 0)) return {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double s = entry.closeness;
    if (box.low[axis] <= 0 && !(box.low[axis] * s <= v[axis])) return {};
    if (box.high[axis] >= 0 && !(v[axis] <= box.high[axis] * s)) return {};
  }
  return entry;
}

double SceneProxy::closeness(int surface, const Vec3& direction) const {
  if (surface < 0) return 0;
  if (surface >= kWalls) {
    const int i = surface - kWalls;
    return obstacles_[static_cast<std::size_t>(i / kFaces)].closeness(i % kFaces, direction);
  }
  if (room_ == Scene::Room::Plane) return dot(plane_, direction);
  if (room_ == Scene::Room::Box) return walls_.closeness(surface, direction);
  return hit_room(direction).closeness;
}

std::optional<Vec3> SceneProxy::meet(const Ray& ray) const {
  double nearest = meet_room(ray);
  for (const Block& box : obstacles_) nearest = std::min(nearest, meet_obstacle(box, ray));
  if (!std::isfinite(nearest)) return std::nullopt;
  return ray.origin + ray.direction * nearest;
}

double SceneProxy::meet_room(const Ray& ray) const {
  switch (room_) {
    case Scene::Room::None:
      return kInfinity;
    case Scene::Room::Sphere: {
      const Vec3 from = ray.origin - centre_;
      const double along = dot(from, ray.direction);
      const double power = radius_ * radius_ - dot(from, from);
      const double root = std::sqrt(along * along + power);
      return root - along;
    }
    case Scene::Room::Plane: {
      const double towards = dot(plane_, ray.direction);
      return towards > 0 ? (1 - dot(plane_, ray.origin)) / towards : kInfinity;
    }
    case Scene::Room::Box:
      return meet_walls(ray);
  }
  return kInfinity;
}

double SceneProxy::meet_walls(const Ray& ray) const {
  const auto o = by_axis(ray.origin), r = by_axis(ray.direction);
  double nearest = kInfinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (r[axis] == 0) continue;
    const double wall = r[axis] > 0 ? walls_.high[axis] : walls_.low[axis];
    nearest = std::min(nearest, (wall - o[axis]) / r[axis]);
  }
  return nearest;
}

double SceneProxy::meet_obstacle(const Block& box, const Ray& ray) {
  const auto o = by_axis(ray.origin), r = by_axis(ray.direction);
  double enter = -kInfinity, leave = kInfinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (r[axis] == 0) {
      if (!(box.low[axis] <= o[axis] && o[axis] <= box.high[axis])) return kInfinity;
      continue;
    }
    const auto [first, second] =
        std::minmax({(box.low[axis] - o[axis]) / r[axis], (box.high[axis] - o[axis]) / r[axis]});
    enter = std::max(enter, first);
    leave = std::min(leave, second);
  }
  return enter > 0 && enter <= leave ? enter : kInfinity;
}

std::vector<std::pair<Vec3, Vec3>> SceneProxy::edges() const {
  std::vector<std::pair<Vec3, Vec3>> edges;
  const bool walled = room_ == Scene::Room::Box;
  if (walled) {
    for_each_edge([&](unsigned corner, unsigned axis) {
      edges.push_back(ends(walls_.low, walls_.high, corner, axis));
    });
  }
  for (const Block& box : obstacles_) {
    const auto part = within_walls(box);
    if (!part) continue;
    const Axes low = by_axis(part->low), high = by_axis(part->high);
    for_each_edge([&](unsigned corner, unsigned axis) {
      if (faces_ball(low, high, corner, axis)) edges.push_back(ends(low, high, corner, axis));
    });
  }
  return edges;
}

std::optional<Box> SceneProxy::within_walls(const Block& obstacle) const {
  Axes low = obstacle.low, high = obstacle.high;
  if (room_ == Scene::Room::Box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::max(low[axis], walls_.low[axis]);
      high[axis] = std::min(high[axis], walls_.high[axis]);
      if (!(low[axis] < high[axis])) return std::nullopt;
    }
  }
  return Box{vector(low), vector(high)};
}

std::vector<SceneProxy::Face> SceneProxy::faces() const {
  std::vector<Face> faces;
  const bool walled = room_ == Scene::Room::Box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool is_high : {false, true}) {
      const int surface = walled ? face(axis, is_high) : 0;
      faces.push_back(walled ? side(grown(walls_.low, walls_.high, axis), axis, is_high, surface)
                             : side({{-1, -1, -1}, {1, 1, 1}}, axis, is_high, surface));
    }
  }
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const auto part = within_walls(obstacles_[i]);
    if (!part) continue;
    const Axes low = by_axis(part->low), high = by_axis(part->high);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(low[axis] > 0) && !(high[axis] < 0)) continue;
      const bool is_high = high[axis] < 0;
      const int surface = kWalls + kFaces * static_cast<int>(i) + face(axis, is_high);
      faces.push_back(side(*part, axis, is_high, surface));
    }
  }
  return faces;
}

bool SceneProxy::lists_every_edge() const {
  if (room_ == Scene::Room::Plane) return false;
  if (room_ == Scene::Room::Sphere) return obstacles_.empty();
  const auto meet = [](const Block& a, const Block& b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis]) return false;
    }
    return true;
  };
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (meet(obstacles_[i], obstacles_[k])) return false;
    }
  }
  return true;
}

}  // namespace orbwatch::optics
