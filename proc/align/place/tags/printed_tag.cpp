// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/tags/printed_tag.h"

#include <algorithm>
#include <cmath>

#include "proc/align/place/tags/tag_finder.h"

namespace orbwatch::align {

using optics::Vec3;

std::array<Vec3, 4> tag_corners(double side, const Vec3& centre, const Vec3& right_way,
                                const Vec3& down_way) {
  const Vec3 right = normalized(right_way) * (side / 2), down = normalized(down_way) * (side / 2);
  return {centre - right - down, centre + right - down, centre + right + down,
          centre - right + down};
}

bool is_square(const std::array<Vec3, 4>& corners) {
  const Vec3 right = corners[1] - corners[0], down = corners[3] - corners[0];
  const double side = norm(right);
  const auto is_near = [&](double value) { return std::abs(value) < 0.01 * side; };
  return side > 0 && std::isfinite(side) && is_near(norm(down) - side) &&
         is_near(dot(right, down) / side) && is_near(norm(corners[2] - corners[1] - down));
}

Result<int> mark_tags(const Picture& picture, std::span<const PrintedTag> tags,
                      UnplacedCamera& camera, PlaceRequest& request, const WorkProgress& progress) {
  std::optional<optics::Lens> lens;
  if (!camera.focal_unknown) {
    const auto known = optics::Lens::make(camera.lens);
    if (!known) return tl::unexpected(known.error());
    lens = *known;
  }
  const auto found = find_tags(picture, camera.outline, lens, progress);
  if (!found) return tl::unexpected(found.error());
  int shown = 0;
  for (const FoundTag& tag : *found) {
    const auto printed = std::ranges::find(tags, tag.id, &PrintedTag::id);
    if (printed == tags.end()) continue;
    ++shown;
    for (std::size_t k = 0; k < tag.corners.size(); ++k) {
      camera.marks.push_back({add_point(request, printed->corners[k]), tag.corners[k]});
    }
  }
  return shown;
}

}  // namespace orbwatch::align
