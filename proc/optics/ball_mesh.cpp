// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/ball_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "proc/optics/resolution.h"

namespace orbwatch::optics {
namespace {

constexpr double kTolerance = 1.0 / 32;  // px of the Ball view
constexpr double kCellDegrees = 8;       // the largest cells
constexpr unsigned kDivisions = 5;       // the smallest are a 32nd of these
// Distance, ball radii, at which everything further is drawn; directions stay the same.
constexpr double kFarthest = 1e4;

/// Lattice of one face with equal angles, as seen from the ball's centre, along both sides.
class FaceLattice {
 public:
  explicit FaceLattice(const SceneProxy::Face& face)
      : face_(face),
        distance_(std::abs(dot(face.corner, normalized(cross(face.along, face.across))))),
        along_(side(face.along)),
        across_(side(face.across)) {}

  int columns() const { return along_.cells; }
  int rows() const { return across_.cells; }

  /// Lattice point; column and row count the smallest cells.
  Vec3 at(std::uint32_t column, std::uint32_t row) const {
    return face_.corner + along_.unit * offset(along_, column) +
           across_.unit * offset(across_, row);
  }

 private:
  struct Side {
    Vec3 unit;
    double low;          ///< coordinate of the corner, from the foot of the perpendicular
    double first, last;  ///< angles, radians
    int cells;
  };

  Side side(const Vec3& vector) const {
    const double length = norm(vector);
    const Vec3 unit = vector * (1 / length);
    const double low = dot(face_.corner, unit);
    const double first = std::atan2(low, distance_), last = std::atan2(low + length, distance_);
    const double cells = std::ceil((last - first) / radians(kCellDegrees));
    return {unit, low, first, last, std::max(1, static_cast<int>(cells))};
  }

  double offset(const Side& side, std::uint32_t k) const {
    const double share = k / static_cast<double>(side.cells << kDivisions);
    return distance_ * std::tan(side.first + (side.last - side.first) * share) - side.low;
  }

  const SceneProxy::Face& face_;
  const double distance_;
  const Side along_;
  const Side across_;
};

class MeshBuilder {
 public:
  explicit MeshBuilder(const ViewProjection& view) : view_(view), ball_(*view.ball()) { predict(); }

  void add(const SceneProxy::Face& face) {
    const FaceLattice lattice(face);
    lattice_ = &lattice;
    surface_ = face.surface;
    corners_.clear();
    constexpr std::uint32_t kCell = 1U << kDivisions;
    for (int row = 0; row < lattice.rows(); ++row) {
      for (int column = 0; column < lattice.columns(); ++column) {
        add_cell(static_cast<std::uint32_t>(column) * kCell,
                 static_cast<std::uint32_t>(row) * kCell, kCell);
      }
    }
  }

  BallMesh take() { return std::move(mesh_); }

 private:
  static constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

  struct Corner {
    Vec3 position;
    std::optional<Vec2> offset;
    std::uint32_t node = kUnused;
  };

  /// Fits the distant ball's picture to the exact one of a far room around the direction that faces
  /// the camera: there the half-way vector turns half as far as the direction.
  void predict() {
    constexpr double kStep = 1e-4;  // radians
    mesh_.facing = ball_.facing();
    // The direction that faces the camera has a pixel; beside it a window may end the picture.
    const auto pixel = [this](const Vec3& direction) {
      const auto shown = ball_.pixel(normalized(direction), 0);
      return shown ? view_.of_camera_pixel(*shown) : mesh_.centre;
    };
    mesh_.centre = pixel(mesh_.facing);
    const Vec3 aside = std::abs(mesh_.facing.z) < 0.7 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    const Vec3 first = normalized(cross(mesh_.facing, aside));
    for (const Vec3& tangent : {first, cross(mesh_.facing, first)}) {
      const Vec2 ahead = pixel(mesh_.facing + tangent * kStep);
      const Vec2 behind = pixel(mesh_.facing - tangent * kStep);
      mesh_.u = mesh_.u + tangent * ((ahead.u - behind.u) / kStep);
      mesh_.v = mesh_.v + tangent * ((ahead.v - behind.v) / kStep);
    }
  }

  /// The corner on the surface in the direction of `point`.
  Corner corner_at(const Vec3& point) const {
    const Vec3 direction = normalized(point);
    const double closeness = std::max(0.0, ball_.proxy().closeness(surface_, direction));
    Corner corner{direction * (1 / std::max(closeness, 1 / kFarthest)), {}};
    if (const auto pixel = ball_.pixel(direction, closeness)) {
      const Vec2 exact = view_.of_camera_pixel(*pixel), distant = mesh_.distant(direction);
      corner.offset = {exact.u - distant.u, exact.v - distant.v};
    }
    return corner;
  }

  Corner& corner(std::uint32_t column, std::uint32_t row) {
    const std::uint64_t key = std::uint64_t{column} << 32U | row;
    const auto found = corners_.find(key);
    if (found != corners_.end()) return found->second;
    return corners_.emplace(key, corner_at(lattice_->at(column, row))).first->second;
  }

  /// True if the offset is linear, within the tolerance, along a straight line on the surface.
  bool is_straight(const Corner& from, const Corner& to) const {
    const Corner middle = corner_at((from.position + to.position) * 0.5);
    return middle.offset &&
           std::hypot((from.offset->u + to.offset->u) / 2 - middle.offset->u,
                      (from.offset->v + to.offset->v) / 2 - middle.offset->v) <= kTolerance;
  }

  void add_cell(std::uint32_t column, std::uint32_t row, std::uint32_t size) {
    Corner& a = corner(column, row);
    Corner& b = corner(column + size, row);
    Corner& c = corner(column, row + size);
    Corner& d = corner(column + size, row + size);
    const int shown =
        (a.offset ? 1 : 0) + (b.offset ? 1 : 0) + (c.offset ? 1 : 0) + (d.offset ? 1 : 0);
    const bool is_fine = shown == 4 && is_straight(a, b) && is_straight(a, c) &&
                         is_straight(b, d) && is_straight(c, d) && is_straight(b, c);
    if (!is_fine && shown > 0 && size > 1) {
      const std::uint32_t half = size / 2;
      for (const std::uint32_t y : {row, row + half}) {
        for (const std::uint32_t x : {column, column + half}) add_cell(x, y, half);
      }
      return;
    }
    auto& triangles = shown == 4 ? mesh_.triangles : mesh_.blind;
    for (Corner* corner : {&a, &b, &c, &c, &b, &d}) triangles.push_back(node(*corner));
  }

  std::uint32_t node(Corner& corner) {
    if (corner.node == kUnused) {
      corner.node = static_cast<std::uint32_t>(mesh_.nodes.size());
      const double seen = corner.offset ? resolution(ball_, normalized(corner.position)) : 0;
      mesh_.nodes.push_back({corner.position, corner.offset.value_or(Vec2{}), seen});
    }
    return corner.node;
  }

  const ViewProjection& view_;
  const BallProjection& ball_;
  const FaceLattice* lattice_ = nullptr;
  int surface_ = 0;
  /// Corners of the current face; references stay valid.
  std::unordered_map<std::uint64_t, Corner> corners_;
  BallMesh mesh_;
};

}  // namespace

BallMesh ball_mesh(const ViewProjection& view) {
  const BallProjection& ball = *view.ball();
  if (!ball.pixel(ball.facing(), 0)) return {};
  MeshBuilder builder(view);
  for (const SceneProxy::Face& face : ball.proxy().faces()) builder.add(face);
  return builder.take();
}

}  // namespace orbwatch::optics
