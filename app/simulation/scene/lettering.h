// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace orbwatch::app::simulation {

/// True if the point (right, up) is on a letter of `text`, painted in capitals of `height` and
/// centred in the origin. Lengths in one unit. Reentrant.
bool on_ink(std::string_view text, double height, double right, double up);

}  // namespace orbwatch::app::simulation
