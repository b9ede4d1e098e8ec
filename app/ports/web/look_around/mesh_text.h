// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "proc/optics/ball_mesh.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app::web {

/// Serialises a mesh for the page: a line of JSON followed by `bytes` bytes of little-endian
/// numbers: six 32-bit floats per node (position x, y, z; offset u, v; resolution), then 32-bit
/// indices of nodes, three per triangle, those in the blind cone last. The line also has the other
/// members of BallMesh, the view's size, the `widths` in which its pictures are sent, and the
/// scene's `edges`, as x, y, z of both ends.
std::string mesh_text(const optics::BallMesh& mesh, const optics::ViewProjection& view);

}  // namespace orbwatch::app::web
