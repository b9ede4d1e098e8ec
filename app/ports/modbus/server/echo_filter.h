// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "hal/clock.h"

namespace orbwatch::app::modbus {

/// Removes echoes of own answers from the bytes read on a serial line. Many RS-485 adapters receive
/// while they send. The answer to functions 5, 6 and 22 equals the request, so its echo would be
/// answered, and the echo of that answer, too, endlessly.
///
/// An echo is the answer, byte by byte, in pieces or joined to the following bytes, within a
/// limited time after it was sent. An answer that is not also a request shows whether the line
/// echoes. On a line without an echo a master's request that repeats the answer at once is a
/// request; several of them in a row are an echo nevertheless. Independent of devices.
/// Thread-bound.
class EchoFilter {
 public:
  explicit EchoFilter(int baud_rate) : baud_rate_(baud_rate) {}

  /// Reports that `answer` was sent at `now`. `is_request`: its bytes equal those of the request.
  /// An empty answer is ignored.
  void expect(std::span<const std::uint8_t> answer, bool is_request, hal::TimePoint now);

  /// Returns `bytes` without echoes. The line was silent until `silent_until`: bytes that are read
  /// late because the computer is busy count as arrived then. Bytes that may begin an echo are held
  /// back until further bytes decide. The result is valid until the next call.
  std::span<const std::uint8_t> strip(std::span<const std::uint8_t> bytes,
                                      hal::TimePoint silent_until);

  /// Reports a received request: echoes of earlier answers are no longer expected.
  void end_wait();

  /// Returns whether an echo is expected, or bytes are held back, until deadline().
  bool is_waiting() const { return !answers_.empty() || !late_.empty(); }
  /// Time at which echoes are given up: strip() of no bytes then returns the held bytes.
  hal::TimePoint deadline() const { return deadline_; }

  /// Number of echoes removed.
  std::uint64_t echoes() const { return echoes_; }

 private:
  struct Answer {
    std::vector<std::uint8_t> bytes;
    bool is_request = false;
  };
  enum class Line { Unknown, WithEcho, WithoutEcho };

  void add(std::uint8_t byte);
  void decide(const Answer& answer);

  const int baud_rate_;
  std::deque<Answer> answers_;      ///< answers whose echoes are expected, oldest first
  hal::TimePoint deadline_{};       ///< deadline of the newest answer
  std::vector<std::uint8_t> held_;  ///< possible beginning of the oldest answer's echo
  std::vector<std::uint8_t> late_;  ///< held until a request in front of them is received
  std::vector<std::uint8_t> passed_;
  Line line_ = Line::Unknown;
  int repetitions_ = 0;  ///< consecutive requests that repeat the answer
  std::uint64_t echoes_ = 0;
};

}  // namespace orbwatch::app::modbus
