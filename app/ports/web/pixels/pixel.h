// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/model/view.h"
#include "proc/optics/scene_proxy.h"
#include "proc/optics/view_projection.h"
#include "proc/signals/signals.h"

namespace orbwatch::app::web {

/// Values at one pixel of a view. Numbers without a value are signals::kNotValid.
struct Pixel {
  std::optional<optics::Vec3> direction;  ///< unit vector, machine frame, from the ball's centre
  Validity validity = Validity::Outside;
  double intensity = signals::kNotValid;  ///< % of full scale, measured if possible, else displayed
  double temperature = signals::kNotValid;  ///< degC of a black body, from the camera's counts
  double distance = signals::kNotValid;     ///< mm from the ball's centre to the scene
  optics::Vec3 point;  ///< point of the scene, machine frame, mm; only with a distance
};

/// Values at the pixel nearest to (u, v), which is inside the view's picture. `projection` is the
/// view's. Reentrant.
Pixel pixel_of(const View& view, const optics::ViewProjection& projection, const optics::Ball& ball,
               const optics::SceneProxy& scene, const optics::Vec2& at);

/// Values at a pixel of the picture sent under `number`, as JSON; null where there is no value:
/// {"number", "stamp", "yaw", "pitch", "seen", "intensity", "temperature", "distance", "point": [x,
/// y, z]}. Reentrant.
std::string pixel_json(const Pixel& pixel, std::uint64_t number, hal::TimePoint stamp);

}  // namespace orbwatch::app::web
