// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/model/alignment.h"

namespace orbwatch::app::web {

/// {"cameras": [...]}: the state of each camera's alignment, as JSON. Pixels are [u, v], points [x,
/// y, z]. Reentrant.
std::string alignment_json(const std::vector<std::string>& cameras,
                           const std::vector<AlignmentReport>& reports);

/// {"yaw": ..., "pitch": ...} of a unit vector, degrees. Reentrant.
std::string direction_json(const optics::Vec3& direction);

}  // namespace orbwatch::app::web
