// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

namespace orbwatch::app::web {

/// Counters of all streams since the start.
struct StreamCounts {
  std::atomic<std::uint64_t> sent{0};     ///< pictures whose transmission was started
  std::atomic<std::uint64_t> skipped{0};  ///< pictures not sent because the reader was slower
};

}  // namespace orbwatch::app::web
