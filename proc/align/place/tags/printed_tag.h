// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>

#include "proc/align/place/placement.h"
#include "proc/align/work_progress.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/lens.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// Tags of the family 36h11 have the ids 0 to kTagIds - 1.
inline constexpr int kTagIds = 587;

/// A printed tag and its place: corners of its black border as printed (top left, top right, bottom
/// right, bottom left), mm, machine frame.
struct PrintedTag {
  int id = 0;
  std::array<optics::Vec3, 4> corners;
};

/// The corners of a tag with that side length, from its centre and the directions, of any length,
/// to its right and down as printed. Reentrant.
std::array<optics::Vec3, 4> tag_corners(double side, const optics::Vec3& centre,
                                        const optics::Vec3& right, const optics::Vec3& down);

/// True if the sides have one length and right angles, to a hundredth: else a number is wrong.
/// Reentrant.
bool is_square(const std::array<optics::Vec3, 4>& corners);

/// Marks in `camera` the corners of the printed tags in its picture, and adds them to the request's
/// points; returns the number of tags found. Takes seconds. Reentrant. Error: those of
/// optics::Lens::make and find_tags().
Result<int> mark_tags(const Picture& picture, std::span<const PrintedTag> tags,
                      UnplacedCamera& camera, PlaceRequest& request,
                      const WorkProgress& progress = {});

}  // namespace orbwatch::align
