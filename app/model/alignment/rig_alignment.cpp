// SPDX-License-Identifier: Apache-2.0
#include "app/model/alignment/rig_alignment.h"

#include <algorithm>

namespace orbwatch::app {
namespace {

void apply(const CameraAlignment& alignment, optics::RigCamera& camera) {
  if (alignment.intrinsics) {
    camera.intrinsics = alignment.intrinsics;
    camera.intrinsics->width = camera.width;
    camera.intrinsics->height = camera.height;
    camera.alpha.reset();
    camera.distance.reset();
  }
  if (alignment.pose) {
    camera.pose = alignment.pose;
    camera.outline.reset();
    camera.registration = {};
    camera.is_registered = true;
    camera.alpha.reset();
    camera.distance.reset();
    return;
  }
  if (!alignment.outline && !alignment.registration) return;
  camera.pose.reset();
  if (alignment.outline) camera.outline = alignment.outline;
  if (!alignment.registration) return;
  camera.registration = *alignment.registration;
  camera.is_registered = true;
}

}  // namespace

Result<> apply(const RigAlignment& alignment, optics::Rig& rig) {
  if (alignment.ball_centre) rig.ball.centre = *alignment.ball_centre;
  for (const CameraAlignment& found : alignment.cameras) {
    const auto camera = std::ranges::find(rig.cameras, found.camera, &optics::RigCamera::name);
    if (camera != rig.cameras.end()) apply(found, *camera);
  }
  for (const optics::RigCamera& camera : rig.cameras) {
    const auto projection = optics::ball_projection(rig, camera);
    if (!projection) return tl::unexpected(projection.error());
  }
  return {};
}

}  // namespace orbwatch::app
