#pragma once

#include <string>

#include "proc/optics/ball_mesh.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app::web {

/// A mesh as the page reads it: a line of JSON and, as its `bytes` says, little-endian numbers: per
/// node six of 32 bit floating point (position x, y, z; offset u, v; resolution), then the nodes'
/// places, 32 bit, three per triangle, those in the blind cone last. The line has what BallMesh
/// states besides, the view's size and the scene's `edges`, as x, y, z of both ends.
std::string mesh_text(const optics::BallMesh& mesh, const optics::ViewProjection& view);

}  // namespace orbwatch::app::web
