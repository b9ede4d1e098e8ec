#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "hal/clock.h"

namespace orbwatch::app::modbus {

/// Drops a serial line's own answers from what is read of it. Many RS-485 adapters leave the
/// receiver on while they send. The answer to functions 5, 6 and 22 is the request once more, so
/// its echo would be answered, that one's too, and so on.
///
/// An echo is the answer, byte by byte, in pieces or glued to what follows, until a while after it
/// was sent. An answer that is no request proves what kind of line it is. On a line without an
/// echo a master's request that repeats the answer at once is a request; several of them in a row
/// are an echo all the same.
/// Knows no device. Thread-bound.
class EchoFilter {
 public:
  explicit EchoFilter(int baud_rate) : baud_rate_(baud_rate) {}

  /// `answer` was sent at `now`. `is_request`: its bytes are those of the request. One without
  /// bytes is none.
  void expect(std::span<const std::uint8_t> answer, bool is_request, hal::TimePoint now);

  /// `bytes`, received at `now`, without echoes. Bytes that may begin one are held back until more
  /// of them shows what they are. The result is valid until the next call.
  std::span<const std::uint8_t> strip(std::span<const std::uint8_t> bytes, hal::TimePoint now);

  /// A request was received: the answers before it have no echo any more.
  void end_wait();

  /// Bytes are held back, until deadline().
  bool is_holding() const { return !held_.empty() || !late_.empty(); }
  /// An echo that is not whole by then is none: strip() of no bytes returns what is held.
  hal::TimePoint deadline() const { return deadline_; }

  /// Answers that were dropped.
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
  std::deque<Answer> answers_;      ///< whose echoes are awaited, oldest first
  hal::TimePoint deadline_{};       ///< of the newest of them
  std::vector<std::uint8_t> held_;  ///< the beginning of the oldest one's echo, perhaps
  std::vector<std::uint8_t> late_;  ///< held until a request was received in front of them
  std::vector<std::uint8_t> passed_;
  Line line_ = Line::Unknown;
  int repetitions_ = 0;  ///< in a row, of requests that repeat the answer
  std::uint64_t echoes_ = 0;
};

}  // namespace orbwatch::app::modbus
