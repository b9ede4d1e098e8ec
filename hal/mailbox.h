#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace orbwatch::hal {

/// A queue of depth one between two threads: the newest value wins, each one that was replaced
/// before it was taken is counted. The sender never waits. Thread-safe, any number of senders, one
/// receiver.
template <class T>
class Mailbox {
 public:
  /// Puts a value in; returns false when it replaced one that nobody took.
  bool put(T value) {
    std::optional<T> replaced;
    {
      const std::lock_guard lock(mutex_);
      replaced = std::exchange(value_, std::move(value));
      drops_ += replaced ? 1 : 0;
    }
    filled_.notify_one();
    return !replaced;
  }

  /// Waits for a value; nothing while the mailbox is closed. One put in before stays in it.
  std::optional<T> take() {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [this] { return value_.has_value() || closed_; });
    if (closed_) return std::nullopt;
    return std::exchange(value_, std::nullopt);
  }

  /// Takes what is there without waiting.
  std::optional<T> try_take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(value_, std::nullopt);
  }

  /// Ends take() until open().
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    filled_.notify_all();
  }

  /// Lets take() wait again.
  void open() {
    const std::lock_guard lock(mutex_);
    closed_ = false;
  }

  std::uint64_t drops() const {
    const std::lock_guard lock(mutex_);
    return drops_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable filled_;
  std::optional<T> value_;
  std::uint64_t drops_ = 0;
  bool closed_ = false;
};

}  // namespace orbwatch::hal
