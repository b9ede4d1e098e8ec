// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace orbwatch::hal {

/// Levels of dark and bright in a test pattern, as shares of a sample's full scale; with a
/// radiometric camera of 0.04 K per count 20 and 1700 degC.
inline constexpr double kDarkLevel = 0.112, kBrightLevel = 0.75;

}  // namespace orbwatch::hal
