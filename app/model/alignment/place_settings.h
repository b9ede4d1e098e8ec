// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "proc/align/place/tags/printed_tag.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

/// A printed tag as a site states it.
struct TagSettings {
  int id = 0;
  double size = 0;                   ///< mm
  optics::Vec3 centre, right, down;  ///< machine frame, mm

  align::PrintedTag tag() const { return {id, align::tag_corners(size, centre, right, down)}; }
};

/// Standard deviations of the facts that cameras are placed by.
struct PlacePrecision {
  double sigma_px = 1;       ///< points as marked in a picture
  double sigma_mm = 1;       ///< points' coordinates
  double outline_sigma = 1;  ///< the ball's outline, px
};

/// The command place_camera's settings, beside the points that were marked by command.
struct PlaceSettings : PlacePrecision {
  std::vector<Located<TagSettings>> tags;
};

inline constexpr std::size_t kMaxTags = 64;

template <class Visitor>
void visit(Visitor& v, TagSettings& tag) {
  v.required("id", tag.id, Range::between(0, align::kTagIds - 1),
             "Id in the AprilTag family 36h11");
  v.required("size", tag.size, Range::above(0, 100000), "Edge length of the black border, mm");
  v.required("centre", tag.centre, kAnyNumber, "Centre of the tag, machine frame, mm");
  v.required("right", tag.right, kAnyNumber,
             "Direction to the tag's right as it is read, machine frame, any length");
  v.required("down", tag.down, kAnyNumber,
             "Direction to the tag's lower side, machine frame, any length");
  v.require(align::is_square(tag.tag().corners), "down", "must be at right angles to right");
}

template <class Visitor>
void visit(Visitor& v, PlaceSettings& place) {
  v.optional("sigma_px", place.sigma_px, Range::above(0, 1000),
             "Accuracy of points in the picture, one sigma, px");
  v.optional("sigma_mm", place.sigma_mm, Range::between(0, 1000),
             "Accuracy of the points' coordinates, one sigma, mm");
  v.optional("outline_sigma", place.outline_sigma, Range::above(0, 1000),
             "Accuracy of the ball's outline in force, one sigma, px");
  v.tables("tag", place.tags, 0, kMaxTags, "Printed AprilTags that are visible in the ball");
  for (std::size_t i = 0; i < place.tags.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      v.require(place.tags[i].id != place.tags[k].id, "tag",
                "id " + std::to_string(place.tags[i].id) + " is there twice");
    }
  }
}

}  // namespace orbwatch::app
