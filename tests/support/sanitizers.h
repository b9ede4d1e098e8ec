#pragma once

#include <string_view>

namespace orbwatch::tests {

/// What this program is built with (toolchains/). A sanitizer keeps what was freed, and waits for
/// locks of its own; the thread sanitizer takes ten times the time and has a thread.
inline constexpr std::string_view kSanitizers = ORBWATCH_SANITIZE;
inline constexpr bool kIsSanitized = !kSanitizers.empty();
inline constexpr bool kHasThreadSanitizer = kSanitizers == "thread";

}  // namespace orbwatch::tests
