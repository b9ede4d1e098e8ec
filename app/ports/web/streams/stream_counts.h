#pragma once

#include <atomic>
#include <cstdint>

namespace orbwatch::app::web {

/// Of all streams since start.
struct StreamCounts {
  std::atomic<std::uint64_t> sent{0};     ///< pictures, begun
  std::atomic<std::uint64_t> skipped{0};  ///< for readers that were slower than the pictures
};

}  // namespace orbwatch::app::web
