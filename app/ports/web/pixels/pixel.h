// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/model/sink/view.h"
#include "app/ports/web/pixels/pixel_records.h"
#include "proc/optics/scene_proxy.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app::web {

/// Values at the pixel nearest to (u, v), which is inside the view's picture, without the picture's
/// number. `projection` is the view's. Reentrant.
PixelAnswer pixel_of(const View& view, const optics::ViewProjection& projection,
                     const optics::Ball& ball, const optics::SceneProxy& scene,
                     const optics::Vec2& at);

}  // namespace orbwatch::app::web
