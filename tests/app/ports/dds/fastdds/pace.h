// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>

namespace orbwatch::app::tests {

/// Acts as the pipeline: passes data at a camera's pace and counts how often it was blocked. A
/// thread that waits for a lock, a socket or another resource makes a voluntary context switch; the
/// system counts these per thread, and they have no other cause here.
class Pace {
 public:
  static constexpr auto kPeriod = std::chrono::milliseconds(33);

  virtual ~Pace() = default;

  /// Waits until the next item is due, then passes it.
  void hand_over() {
    std::this_thread::sleep_until(due_);
    due_ += kPeriod;
    const auto before = given_up();
    const auto begin = std::chrono::steady_clock::now();
    hand_over_now(++accepted_);
    if (given_up() == before) return;
    ++waits_;
    longest_wait_ = std::max<std::chrono::duration<double, std::milli>>(
        longest_wait_, std::chrono::steady_clock::now() - begin);
  }
  void hand_over(int count) {
    for (int i = 0; i < count; ++i) hand_over();
  }

  /// Restarts the pace now, instead of catching up.
  void restart() { due_ = std::chrono::steady_clock::now(); }

  std::uint64_t accepted() const { return accepted_; }
  /// Number of passes that waited.
  std::uint64_t waits() const { return waits_; }
  double longest_wait_ms() const { return longest_wait_.count(); }

 protected:
  /// Passes the item of that number, counted from 1.
  virtual void hand_over_now(std::uint64_t number) = 0;

 private:
  static std::uint64_t given_up() {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return static_cast<std::uint64_t>(usage.ru_nvcsw);
  }

  std::chrono::steady_clock::time_point due_ = std::chrono::steady_clock::now();
  std::uint64_t accepted_ = 0;
  std::uint64_t waits_ = 0;
  std::chrono::duration<double, std::milli> longest_wait_{0};
};

}  // namespace orbwatch::app::tests
