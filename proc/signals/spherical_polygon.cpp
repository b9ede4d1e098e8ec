// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/spherical_polygon.h"

#include <cmath>
#include <string>
#include <utility>

namespace orbwatch::signals {
namespace {

using optics::Vec2;
using optics::Vec3;

/// Pieces of an edge, so that lines of pixels follow the curvature of the view.
constexpr int kPieces = 48;

bool shows(const optics::ViewProjection& view, const Vec2& pixel) {
  return pixel.u >= -0.5 && pixel.u <= view.width() - 0.5 && pixel.v >= -0.5 &&
         pixel.v <= view.height() - 0.5;
}

/// Collects the lines of those pieces that a view shows.
class Lines {
 public:
  explicit Lines(const optics::ViewProjection& view) : view_(view) {}

  void add(const std::optional<Vec2>& pixel) {
    const bool is_piece = last_ && pixel && (shows(view_, *last_) || shows(view_, *pixel)) &&
                          !runs_around(*last_, *pixel);
    if (!is_piece) end();
    if (is_piece && line_.empty()) line_.push_back(*last_);
    if (is_piece) line_.push_back(*pixel);
    last_ = pixel;
  }
  std::vector<std::vector<Vec2>> take() {
    end();
    return std::move(lines_);
  }

 private:
  /// True for a piece through the seam of a panorama: no other piece is half as wide.
  bool runs_around(const Vec2& from, const Vec2& to) const {
    return std::abs(to.u - from.u) > view_.width() / 2.0;
  }
  void end() {
    if (!line_.empty()) lines_.push_back(std::exchange(line_, {}));
  }

  const optics::ViewProjection& view_;
  std::optional<Vec2> last_;
  std::vector<Vec2> line_;
  std::vector<std::vector<Vec2>> lines_;
};

}  // namespace

Result<SphericalPolygon> SphericalPolygon::make(std::span<const Vec3> outline) {
  if (outline.size() < 3) {
    return fail("region: an outline has at least 3 corners, not " + std::to_string(outline.size()));
  }
  Vec3 sum;
  for (const Vec3& corner : outline) {
    const double length = optics::norm(corner);
    if (!(length > 0) || !std::isfinite(length)) {
      return fail("region: a corner of the outline has no direction");
    }
    sum = sum + corner * (1 / length);
  }
  SphericalPolygon polygon(sum);
  for (const Vec3& corner : outline) {
    const auto place = polygon.project(optics::normalized(corner));
    if (!place) return fail("region: the outline must fit into half of the sphere");
    polygon.corners_.push_back(*place);
  }
  return polygon;
}

/// Uses the parity of edges that a ray to the right crosses.
bool SphericalPolygon::contains(const Vec3& direction) const {
  const auto place = project(direction);
  if (!place) return false;
  bool inside = false;
  for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++) {
    const Vec2 &a = corners_[i], &b = corners_[j];
    if ((a.v > place->v) == (b.v > place->v)) continue;
    const double crossing = a.u + (place->v - a.v) / (b.v - a.v) * (b.u - a.u);
    inside = inside != (place->u < crossing);
  }
  return inside;
}

/// Pieces span equal angles, so that none is long.
std::vector<std::vector<Vec2>> SphericalPolygon::lines_in(
    const optics::ViewProjection& view) const {
  Lines lines(view);
  lines.add(view.pixel(direction_of(corners_.front())));
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vec3 from = direction_of(corners_[i]);
    const Vec3 to = direction_of(corners_[(i + 1) % corners_.size()]);
    const double sine = optics::norm(optics::cross(from, to));
    const double angle = std::atan2(sine, optics::dot(from, to));
    for (int n = 1; n <= kPieces; ++n) {
      const double share = double(n) / kPieces;
      const Vec3 between = sine > 0 ? from * (std::sin((1 - share) * angle) / sine) +
                                          to * (std::sin(share * angle) / sine)
                                    : to;
      lines.add(view.pixel(optics::normalized(between)));
    }
  }
  return lines.take();
}

SphericalPolygon::SphericalPolygon(const Vec3& sum) {
  const double length = optics::norm(sum);
  if (!(length > 0)) return;  // no corner has a place then
  middle_ = sum * (1 / length);
  const Vec3 aside = std::abs(middle_.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  right_ = optics::normalized(optics::cross(middle_, aside));
  up_ = optics::cross(right_, middle_);
}

std::optional<Vec2> SphericalPolygon::project(const Vec3& direction) const {
  constexpr double kHorizon = 1e-3;  // cosine; places beyond it tend to infinity
  const double depth = optics::dot(direction, middle_);
  if (!(depth > kHorizon)) return std::nullopt;
  return Vec2{optics::dot(direction, right_) / depth, optics::dot(direction, up_) / depth};
}

Vec3 SphericalPolygon::direction_of(const Vec2& place) const {
  return optics::normalized(middle_ + right_ * place.u + up_ * place.v);
}

}  // namespace orbwatch::signals
