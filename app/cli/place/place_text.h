// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "proc/align/place/placement.h"

namespace orbwatch::app::cli {

/// For people: poses, how well they are known, and by how much each point is off.
std::string place_text(const align::PlaceRequest& request, const align::Placement& placement);

/// One JSON object (RFC 8259), as documented in `orbwatch place --help`.
std::string place_json(const align::PlaceRequest& request, const align::Placement& placement);

}  // namespace orbwatch::app::cli
