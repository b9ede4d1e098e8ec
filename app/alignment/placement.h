// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "app/model/alignment/alignment.h"
#include "app/model/alignment/place_settings.h"
#include "app/model/alignment/rig_alignment.h"
#include "proc/align/place/placement.h"
#include "proc/align/place/tags/printed_tag.h"
#include "proc/align/work_progress.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// A known point, and the pixel of a camera's picture that shows it.
struct KnownPoint {
  optics::Vec2 pixel;
  optics::Vec3 point;  ///< machine frame, mm
};

/// A rig's camera as it is to be placed, without outline and marks. Reentrant. Error: it has no
/// intrinsics although its focal length is to be known; a ball model that knows no distances.
Result<align::UnplacedCamera> unplaced_camera(const optics::RigCamera& camera, bool focal_unknown);

/// A request to place cameras of a rig, without cameras. Reentrant.
align::PlaceRequest place_request(const optics::Rig& rig, const PlacePrecision& precision,
                                  align::BallCentre::Knowledge centre, double centre_sigma = 0);

/// Adds a camera with its outline, the points that it shows, and the tags that `picture` shows, if
/// there is one. Points with the same coordinates are one point. Takes seconds if there are tags.
/// Reentrant. Error: those of align::mark_tags().
Result<> add_camera(align::PlaceRequest& request, align::UnplacedCamera camera,
                    std::span<const KnownPoint> points, const Picture* picture,
                    std::span<const align::PrintedTag> tags,
                    const align::WorkProgress& progress = {});

/// Alignment of the rig by a placement. Reentrant. Error: points that contradict the others.
Result<RigAlignment> rig_alignment(const align::PlaceRequest& request,
                                   const align::Placement& placement);

/// The rms length of the residuals of a placed camera's marks, px. Reentrant.
double rms_residual(const align::PlacedCamera& camera);

/// The points of a placed camera. Reentrant.
std::vector<PlacedPoint> placed_points(const align::PlaceRequest& request,
                                       const align::Placement& placement, std::size_t camera);

/// The residuals in one line, "(X, Y, Z mm) U, V px; ...". Reentrant.
std::string residuals_text(const align::PlaceRequest& request, const align::Placement& placement,
                           std::size_t camera);

}  // namespace orbwatch::app
