// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/ports/web/streams/view_query.h"
#include "proc/image/picture.h"
#include "proc/optics/vec.h"
#include "proc/settings/settings.h"
#include "proc/signals/signals.h"

/// Records of pixels.
namespace orbwatch::app::web {

struct PixelQuery : ViewQuery {
  std::optional<std::uint64_t> number;
  optics::Vec2 pixel;
};
template <class Visitor>
void visit(Visitor& v, PixelQuery& query) {
  const Range place = Range::between(0, kMaxSide);
  visit(v, static_cast<ViewQuery&>(query));
  v.optional("number", query.number, "Number of the picture in the stream; default: the next one");
  v.required("u", query.pixel.u, place, "To the right, pixel centres at integers", "px");
  v.required("v", query.pixel.v, place, "Down", "px");
}

/// Values at one pixel of a picture of the live stream.
struct PixelAnswer {
  std::uint64_t number = 0;
  std::string stamp;
  double yaw = signals::kNotValid, pitch = signals::kNotValid;
  bool seen = false;
  double intensity = signals::kNotValid, temperature = signals::kNotValid;
  double distance = signals::kNotValid;
  std::optional<optics::Vec3> point;
};
template <class Visitor>
void visit(Visitor& v, PixelAnswer& answer) {
  v.required("number", answer.number, "Number of the picture in the stream");
  v.required("stamp", answer.stamp, "Start of its exposure, UTC, ISO 8601");
  v.required("yaw", answer.yaw, "From +Y towards +X; null: the pixel has no direction", "deg");
  v.required("pitch", answer.pitch, "Up positive; null: the pixel has no direction", "deg");
  v.required("seen", answer.seen, "A camera sees this direction");
  v.required("intensity", answer.intensity, "Measured if possible, else displayed", "%");
  v.required("temperature", answer.temperature,
             "Temperature of a black body; null: no radiometric camera sees it", "degC");
  v.required("distance", answer.distance, "From the ball's centre to the scene; null: far", "mm");
  v.required("point", answer.point, "Point on the scene, machine frame; null: far", "mm");
}

}  // namespace orbwatch::app::web
