#pragma once

#include <atomic>
#include <cstdint>

#include "app/modbus/snapshot.h"

namespace orbwatch::app::modbus {

/// Counts of Statistics; written by the serving threads, read by any.
struct Counters {
  std::atomic<std::uint64_t> answered{0};
  std::atomic<std::uint64_t> refused{0};
  std::atomic<std::uint64_t> dropped{0};
  std::atomic<std::uint64_t> connections{0};
  std::atomic<std::uint64_t> broken{0};
  std::atomic<std::uint64_t> for_others{0};

  Statistics read() const { return {answered, refused, dropped, connections, broken, for_others}; }
};

}  // namespace orbwatch::app::modbus
