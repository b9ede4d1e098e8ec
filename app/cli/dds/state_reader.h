#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "app/cli/dds/received_state.h"
#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/topics/topic_reader.h"

namespace orbwatch::app {

/// Receives a state, which is valid during the call only.
using AcceptState = std::function<void(const ReceivedState& state)>;

/// Reads the process state of an orbwatchd; the newest wins. Thread-bound.
class StateReader {
 public:
  explicit StateReader(const std::string& prefix);

  /// Joins the domain, with `security` where orbwatchd has it. Errors: as Participant::join, DDS
  /// refuses.
  Result<> open(int domain, const std::optional<SecuritySettings>& security = std::nullopt);

  /// Calls `accept` with the newest state that was not passed to it before, if one arrives within
  /// `timeout`; returns whether one did. The first one arrives as soon as orbwatchd is discovered.
  /// Invalid states are skipped: anybody may write them. Error: DDS refuses.
  Result<bool> next(std::chrono::nanoseconds timeout, const AcceptState& accept);

  /// Why the newest invalid state was refused; empty when there was none.
  const std::string& refusal() const { return refusal_; }

 private:
  Participant participant_;
  TopicReader states_;
  Entity wait_set_;
  std::string refusal_;
};

}  // namespace orbwatch::app
