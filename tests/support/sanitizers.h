// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace orbwatch::tests {

/// Sanitizers of this build (toolchains/). A sanitizer keeps freed memory, and waits for locks of
/// its own; the thread sanitizer is ten times slower and has a thread.
inline constexpr std::string_view kSanitizers = ORBWATCH_SANITIZE;
inline constexpr bool kIsSanitized = !kSanitizers.empty();
inline constexpr bool kHasThreadSanitizer = kSanitizers == "thread";

}  // namespace orbwatch::tests
