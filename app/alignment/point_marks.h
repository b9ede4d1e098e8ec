// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "app/alignment/placement.h"
#include "proc/align/place/small_lights.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::app {

/// Points to place one camera by, one after the other: a user states the pixel, or the machine
/// moves a light to known coordinates; it is the one that has moved among the lights that the ball
/// shows. Thread-bound.
class PointMarks {
 public:
  static constexpr std::size_t kMost = 64;

  /// Adds a point; one with the same coordinates is replaced. `pictures` were taken while the light
  /// stood there. Error, and nothing is added: those of align::small_lights(), no light that moved
  /// since the other points, kMost points.
  Result<> add(const optics::Vec3& point, std::span<const Picture> pictures,
               const optics::Outline& outline);

  /// The same for one that the picture shows at `pixel`. Error: kMost points.
  Result<> add(const optics::Vec3& point, const optics::Vec2& pixel);

  /// False: no point has these coordinates.
  bool remove(const optics::Vec3& point);
  void clear() { points_.clear(); }
  std::size_t size() const { return points_.size(); }

  /// The points, and where the picture shows them; of a camera with that outline. Error: one at
  /// which no light of its own is seen.
  Result<std::vector<KnownPoint>> points(const optics::Outline& outline) const;

 private:
  struct SeenPoint {
    optics::Vec3 point;
    std::vector<align::SmallLight> lights;
    std::optional<optics::Vec2> pixel;  ///< stated by a user, without lights
  };
  std::vector<SeenPoint> others(const optics::Vec3& point) const;
  static Result<optics::Vec2> place_of(std::span<const SeenPoint> points, std::size_t index,
                                       const optics::Outline& outline);

  std::vector<SeenPoint> points_;
};

}  // namespace orbwatch::app
