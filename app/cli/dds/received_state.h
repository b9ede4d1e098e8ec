#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/model/readings.h"
#include "app/ports/dds/status/process_state.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// A received process state is refused when one of its lists or texts is longer than this.
inline constexpr std::size_t kMaxListLength = 1000;
inline constexpr std::size_t kMaxTextLength = 1000;

/// A process state in a received sample. Its texts are views of the sample, which outlives it.
struct ReceivedState {
  std::chrono::system_clock::time_point stamp;  ///< UTC; the epoch: no frame set yet
  std::uint64_t frame_set = 0;
  std::uint64_t trigger = 0;
  std::uint64_t result = 0;
  std::uint16_t recipe = 0;
  std::uint32_t configuration_checksum = 0;
  SystemState system_state = SystemState::Starting;
  std::uint64_t heartbeat = 0;
  std::vector<ComponentReadings> components;  ///< kinds and names of figures are snake_case
};

/// Checks a message from the network. Errors: an unknown system state, a list or text that is too
/// long, a kind or a name of a figure that is not snake_case. Reentrant.
Result<ReceivedState> check_process_state(const ProcessStateMessage& message);

}  // namespace orbwatch::app
