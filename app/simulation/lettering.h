#pragma once

#include <string_view>

namespace orbwatch::app::simulation {

/// Whether the point (right, up) lies on ink, when `text` is painted in capitals of `height` with
/// the middle of its line in the origin. Lengths in one unit. Reentrant.
bool on_ink(std::string_view text, double height, double right, double up);

}  // namespace orbwatch::app::simulation
