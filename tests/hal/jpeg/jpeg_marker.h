// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace orbwatch::hal {

/// Bytes of a marker without a segment, such as the one at a picture's end.
inline constexpr std::size_t kMarkerBytes = 2;

}  // namespace orbwatch::hal
