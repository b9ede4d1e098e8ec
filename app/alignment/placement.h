#pragma once

#include <string>

#include "app/model/rig_alignment.h"
#include "proc/align/place/placement.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// A rig's camera as it is to be placed, without outline and marks. Reentrant. Error: it has no
/// intrinsics although its focal length is to be known; a ball model that knows no distances.
Result<align::UnplacedCamera> unplaced_camera(const optics::RigCamera& camera, bool focal_unknown);

/// What a placement says of the rig. Reentrant. Error: one with points that were left out.
Result<RigAlignment> rig_alignment(const align::PlaceRequest& request,
                                   const align::Placement& placement);

/// The rms length of the residuals of a placed camera's marks, px. Reentrant.
double rms_residual(const align::PlacedCamera& camera);

/// The residuals in one line, "(X, Y, Z mm) U, V px; ...". Reentrant.
std::string residuals_text(const align::PlaceRequest& request, const align::Placement& placement,
                           std::size_t camera);

}  // namespace orbwatch::app
