// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace orbwatch::app {

/// Advice for a camera that is not registered.
inline constexpr std::string_view kRegisterAdvice =
    "register it (`orbwatch register`, or the commands register_camera and accept_alignment)";

}  // namespace orbwatch::app
