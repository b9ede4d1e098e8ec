#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "app/dds/participant.h"
#include "app/dds/process_state.h"
#include "app/dds/topic_reader.h"

namespace orbwatch::app {

/// Reads the process state of an orbwatchd; the newest wins. Thread-bound.
class StateReader {
 public:
  explicit StateReader(const std::string& prefix);

  /// Joins the domain, with `security` where orbwatchd has it. Errors: as Participant::join, DDS
  /// refuses.
  Result<> open(int domain, const std::optional<SecuritySettings>& security = std::nullopt);

  /// The newest state that was not returned yet, if one comes within `timeout`. The first one comes
  /// as soon as orbwatchd is found. One that does not add up is none: anybody may write them.
  /// Error: DDS refuses.
  Result<std::optional<ReceivedState>> next(std::chrono::nanoseconds timeout);

  /// Why the newest one that does not add up is none; empty when there was none.
  const std::string& refusal() const { return refusal_; }

 private:
  Participant participant_;
  TopicReader states_;
  Entity wait_set_;
  std::string refusal_;
};

}  // namespace orbwatch::app
