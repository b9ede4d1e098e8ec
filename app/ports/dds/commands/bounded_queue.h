// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace orbwatch::app {

/// A queue between threads that holds `Capacity` values and allocates nothing: a value that does
/// not fit is refused and counted. Never waits. Thread-safe, any number of senders and receivers.
template <class T, std::size_t Capacity>
class BoundedQueue {
 public:
  /// Appends `value`; returns false if the queue is full.
  bool put(T value) {
    const std::lock_guard lock(mutex_);
    if (size_ == Capacity) {
      ++drops_;
      return false;
    }
    values_[(first_ + size_++) % Capacity] = std::move(value);
    return true;
  }

  /// Removes and returns the oldest value; nullopt: the queue is empty.
  std::optional<T> try_take() {
    const std::lock_guard lock(mutex_);
    if (size_ == 0) return std::nullopt;
    --size_;
    return std::exchange(values_[std::exchange(first_, (first_ + 1) % Capacity)], T{});
  }

  std::uint64_t drops() const {
    const std::lock_guard lock(mutex_);
    return drops_;
  }

 private:
  mutable std::mutex mutex_;
  std::array<T, Capacity> values_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::uint64_t drops_ = 0;
};

}  // namespace orbwatch::app
