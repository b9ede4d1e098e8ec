#pragma once

#include <optional>
#include <string>

#include "app/model/view.h"
#include "proc/optics/scene_proxy.h"
#include "proc/optics/view_projection.h"
#include "proc/signals/signals.h"

namespace orbwatch::app::web {

/// What one pixel of a view shows. Numbers are not valid (signals::kNotValid) where there are none.
struct Pixel {
  std::optional<optics::Vec3> direction;  ///< unit vector, machine frame, from the ball's centre
  Validity validity = Validity::Outside;
  double intensity = signals::kNotValid;    ///< % of full scale: as measured, else as shown
  double temperature = signals::kNotValid;  ///< degC of a black body, as the camera's counts say
  double distance = signals::kNotValid;     ///< mm from the ball's centre to the scene
  optics::Vec3 point;                       ///< there, machine frame, mm; with a distance only
};

/// The pixel nearest to (u, v), which lies in the picture that the view has. `projection` is the
/// view's. Reentrant.
Pixel pixel_of(const View& view, const optics::ViewProjection& projection, const optics::Ball& ball,
               const optics::SceneProxy& scene, const optics::Vec2& at);

/// What is known of a pixel of the picture that was sent under that number, as JSON; null where
/// there is nothing: {"number", "stamp", "yaw", "pitch", "seen", "intensity", "temperature",
/// "distance", "point": [x, y, z]}. Reentrant.
std::string pixel_json(const Pixel& pixel, std::uint64_t number, hal::TimePoint stamp);

}  // namespace orbwatch::app::web
