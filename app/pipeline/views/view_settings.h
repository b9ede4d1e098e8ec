// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/pictures/colour_maps.h"
#include "app/pipeline/views/picture_use.h"
#include "app/pipeline/views/view_plan.h"
#include "proc/image/picture.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/remap.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::pipeline {

/// Default strength of sharpening: about as sharp as bicubic interpolation.
inline constexpr double kSharpness = 0.8;
inline constexpr Range kSharpnesses = Range::between(0, remap::kMaxSharpness);

/// One camera of a view.
struct SourceSettings {
  Reference camera;
  double weight = 1;
  std::string colour_map = "grey";
  double sharpness = kSharpness;
  std::optional<std::array<double, 2>> range;  ///< first and last colour; nullopt: 0 to 100
};

/// First and last colour: degC for a radiometric camera, else percent of full scale.
inline std::array<double, 2> range_of(const SourceSettings& source) {
  return source.range.value_or(std::array<double, 2>{0, 100});
}

/// A view as files state it: degrees, and names of cameras.
struct ViewSettings {
  std::string name;
  std::size_t index = 0;  ///< among all views, once all files are loaded
  optics::ViewKind kind = optics::ViewKind::Perspective;
  double yaw = 0;
  double pitch = 0;
  double roll = 0;
  std::optional<double> h_fov;
  std::optional<double> v_fov;
  int width = 0;
  int height = 0;
  Combine combine = Combine::Mix;
  remap::Interpolation interpolation = remap::Interpolation::Area;
  PixelFormat encoding = PixelFormat::Rgb;
  bool match = true;
  std::vector<Located<SourceSettings>> sources;

  optics::ViewSpec spec() const { return {kind, {yaw, pitch, roll}, h_fov, v_fov, width, height}; }
};

/// A view that a recipe measures in; it cannot be pointed.
struct MeasuredViewSettings : ViewSettings {
  Reference measured;  ///< one of its sources, by the camera's name
};

inline constexpr std::array kViewKinds{Word{"perspective", optics::ViewKind::Perspective},
                                       Word{"equirectangular", optics::ViewKind::Equirectangular},
                                       Word{"cylindrical", optics::ViewKind::Cylindrical},
                                       Word{"stereographic", optics::ViewKind::Stereographic},
                                       Word{"fisheye", optics::ViewKind::Fisheye},
                                       Word{"ball", optics::ViewKind::Ball}};
inline constexpr std::array kCombines{Word{"mix", Combine::Mix},
                                      Word{"sharpest", Combine::Sharpest},
                                      Word{"switch", Combine::Switch}};
/// By their names in ROS 2.
inline constexpr std::array kEncodings{Word{"rgb8", PixelFormat::Rgb},
                                       Word{"bgr8", PixelFormat::Bgr},
                                       Word{"mono8", PixelFormat::Grey}};
inline constexpr Range kSide = Range::between(1, kMaxSide);

template <class Visitor>
void visit(Visitor& v, SourceSettings& source) {
  v.required("camera", source.camera, "Name of the camera");
  v.optional(
      "weight", source.weight, Range::above(0, 1000),
      "Weight where several cameras overlap; sharpest multiplies it by (pixels per degree)^4");
  v.optional("colour_map", source.colour_map, kColourMapNames,
             "Colour map of a one-channel camera");
  v.optional("range", source.range, kAnyNumber,
             "Values of the first and the last colour: degC for a radiometric camera, else percent "
             "of full scale");
  v.optional("sharpness", source.sharpness, kSharpnesses,
             "Sharpening of an 8-bit colour camera's picture for display, never for measurement; "
             "0: none. At most 4 different values per camera");
  static_assert(kMaxSharpnesses == 4);
  v.require(!source.range || (*source.range)[0] < (*source.range)[1], "range",
            "the first number must be below the second");
}

template <class Visitor>
void visit(Visitor& v, ViewSettings& view) {
  v.required("name", view.name, "View name, part of its DDS topic: letters, digits and _");
  v.optional("kind", view.kind, kViewKinds,
             "Projection; ball is the first camera's own picture of the ball, which has no angles");
  v.optional("yaw", view.yaw, kAnyNumber, "Yaw, deg, from +Y towards +X");
  v.optional("pitch", view.pitch, kAnyNumber, "Pitch, deg, up positive");
  v.optional("roll", view.roll, kAnyNumber, "Roll, deg, positive lowers the right side");
  v.optional("h_fov", view.h_fov, Range::above(0, 360),
             "Horizontal field of view, deg, edge to edge; default: 90 perspective (must be below "
             "180), 180 stereographic and fisheye, 360 the others");
  v.optional(
      "v_fov", view.v_fov, Range::above(0, 360),
      "Vertical field of view, deg; default: 180 equirectangular, the others from square pixels");
  v.required("width", view.width, kSide, "Picture width, px");
  v.required("height", view.height, kSide, "Picture height, px");
  v.optional("combine", view.combine, kCombines,
             "mix: cameras blended by weight; sharpest: by resolution; switch: the first listed "
             "camera that sees the direction and delivers. A camera fills directions that others "
             "do not see, and fades out where its resolution is poor, except with switch");
  v.optional("interpolation", view.interpolation, remap::kInterpolations,
             "Interpolation between source pixels; area averages where the view has a lower "
             "resolution than the picture");
  v.optional("encoding", view.encoding, kEncodings, "Encoding of the view's raw pictures over DDS");
  v.optional("match", view.match,
             "Match the exposure of colour cameras where their pictures overlap; measurements are "
             "unaffected");
  v.tables("source", view.sources, 1, remap::kMaxSources, "Cameras that the view shows");
}

template <class Visitor>
void visit(Visitor& v, MeasuredViewSettings& view) {
  visit(v, static_cast<ViewSettings&>(view));
  v.required("measured", view.measured, "Name of the view's camera that is measured");
}

}  // namespace orbwatch::app::pipeline
