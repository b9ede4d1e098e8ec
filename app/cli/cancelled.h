#pragma once

#include <atomic>

namespace orbwatch::app {

/// Becomes true at SIGINT (Ctrl-C) or SIGTERM, which do not terminate the process from the first
/// call on.
const std::atomic<bool>& cancelled_by_signal();

}  // namespace orbwatch::app
