// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

#include "hal/thread/priority_mutex.h"

namespace orbwatch::hal {

/// Queue of work between threads, oldest first. Holds `Capacity` values: a further one is refused
/// and counted. Allocates nothing, and holds its lock only while values are moved or compared, so
/// that the frame path may put. The sender wakes the thread that does the work:
///
///     if (queue_.put(work)) thread_.wake();
///
/// That thread decides what its stop means. This one drains the queue; without the last line it
/// drops what waits:
///
///     while (thread_.wait()) work_all();  // while (auto work = queue_.try_take()) ...
///     work_all();
///
/// Thread rule: thread-safe, any number of senders and receivers; never waits for work.
template <class T, std::size_t Capacity>
class BoundedQueue {
 public:
  /// Appends `value`. False: the queue is full.
  bool put(T value) {
    const std::lock_guard lock(mutex_);
    return append(value);
  }

  /// Appends `value` unless `most` values that satisfy `matches` wait already. False: they do, or
  /// the queue is full. `matches` is called under the lock.
  template <class Matches>
  bool put(T value, std::size_t most, const Matches& matches) {
    const std::lock_guard lock(mutex_);
    std::size_t found = 0;
    for (std::size_t i = 0; i < size_; ++i) found += matches(std::as_const(at(i))) ? 1 : 0;
    if (found < most) return append(value);
    ++drops_;
    return false;
  }

  /// Removes and returns the oldest value; nullopt: the queue is empty.
  std::optional<T> try_take() {
    const std::lock_guard lock(mutex_);
    if (size_ == 0) return std::nullopt;
    std::optional<T> oldest(std::exchange(at(0), T{}));
    first_ = (first_ + 1) % Capacity;
    --size_;
    return oldest;
  }

  /// Number of refused values.
  std::uint64_t drops() const {
    const std::lock_guard lock(mutex_);
    return drops_;
  }

 private:
  T& at(std::size_t place) { return values_[(first_ + place) % Capacity]; }

  bool append(T& value) {
    if (size_ == Capacity) {
      ++drops_;
      return false;
    }
    at(size_++) = std::move(value);
    return true;
  }

  mutable PriorityMutex mutex_;
  std::array<T, Capacity> values_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::uint64_t drops_ = 0;
};

}  // namespace orbwatch::hal
