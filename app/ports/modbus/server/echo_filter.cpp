// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/echo_filter.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace orbwatch::app::modbus {
namespace {

/// The longest time between the end of an answer on the line and the arrival of its echo, with USB
/// adapters and a busy computer. A master without an answer repeats its request later than that.
constexpr std::chrono::milliseconds kLatency{150};

/// Limit of consecutive requests that equal the answer on a line without an echo. More of them mean
/// that an echo has begun, which would otherwise be answered for ever.
constexpr int kMostRepetitions = 3;

constexpr std::chrono::microseconds transmission_time(std::size_t characters, int baud_rate) {
  constexpr std::int64_t kBitsOfCharacter = 11;
  return std::chrono::microseconds(static_cast<std::int64_t>(characters) * kBitsOfCharacter *
                                   1'000'000 / baud_rate);
}

}  // namespace

void EchoFilter::expect(std::span<const std::uint8_t> answer, bool is_request, hal::TimePoint now) {
  if (answer.empty()) return;
  answers_.push_back({{answer.begin(), answer.end()}, is_request});
  std::size_t characters = 0;
  for (const Answer& sent : answers_) characters += sent.bytes.size();
  deadline_ = now + transmission_time(characters, baud_rate_) + kLatency;
}

std::span<const std::uint8_t> EchoFilter::strip(std::span<const std::uint8_t> bytes,
                                                hal::TimePoint silent_until) {
  passed_ = std::exchange(late_, {});
  if (silent_until >= deadline_) end_wait();
  std::ranges::copy(std::exchange(late_, {}), std::back_inserter(passed_));
  for (const std::uint8_t byte : bytes) add(byte);
  return passed_;
}

void EchoFilter::end_wait() {
  late_ = std::exchange(held_, {});
  if (answers_.empty()) return;
  if (!answers_.front().is_request) line_ = Line::WithoutEcho;
  repetitions_ = 0;
  answers_.clear();
}

/// Passes bytes that cannot begin the echo, including stray bytes in front of it.
void EchoFilter::add(std::uint8_t byte) {
  held_.push_back(byte);
  const auto may_be_echo = [this] {
    return !answers_.empty() &&
           std::ranges::mismatch(held_, answers_.front().bytes).in1 == held_.end();
  };
  while (!held_.empty() && !may_be_echo()) {
    passed_.push_back(held_.front());
    held_.erase(held_.begin());
  }
  if (held_.empty() || held_.size() < answers_.front().bytes.size()) return;
  const Answer answer = std::move(answers_.front());
  answers_.pop_front();
  decide(answer);
}

/// Decides about held bytes that equal `answer`.
void EchoFilter::decide(const Answer& answer) {
  const auto bytes = std::exchange(held_, {});
  if (answer.is_request && line_ == Line::WithoutEcho && ++repetitions_ <= kMostRepetitions) {
    passed_.insert(passed_.end(), bytes.begin(), bytes.end());
    return;
  }
  ++echoes_;
  repetitions_ = 0;
  if (!answer.is_request) {
    line_ = Line::WithEcho;
  } else if (line_ == Line::WithoutEcho) {
    line_ = Line::Unknown;
  }
}

}  // namespace orbwatch::app::modbus
