// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/model/status/readings.h"
#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/status/process_state.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

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
Result<ReceivedState> check_process_state(const dds::ProcessStateMessage& message);

/// Receives a state, which is valid during the call only.
using AcceptState = std::function<void(const ReceivedState& state)>;

/// Reads the process state of an orbwatchd; the newest wins. Thread-bound.
class StateReader {
 public:
  explicit StateReader(const std::string& prefix);

  /// Joins the domain, with `security` if orbwatchd has it. Errors: as Participant::join, DDS
  /// refuses.
  Result<> open(int domain, const std::optional<dds::SecuritySettings>& security = std::nullopt);

  /// Calls `accept` with the newest state that was not passed to it before, if one arrives within
  /// `timeout`; returns true if one did. The first one arrives as soon as orbwatchd is discovered.
  /// Invalid states are skipped, since any participant may write them. Error: DDS refuses.
  Result<bool> next(std::chrono::nanoseconds timeout, const AcceptState& accept);

  /// Reason why the newest invalid state was refused; empty when there was none.
  const std::string& refusal() const { return refusal_; }

 private:
  dds::Participant participant_;
  dds::TopicReader states_;
  dds::Entity wait_set_;
  std::string refusal_;
};

}  // namespace orbwatch::app::cli
