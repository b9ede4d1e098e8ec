// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>

namespace orbwatch::hal {

/// Wakes a thread that waits for work. A ring without a waiting thread is kept; several count as
/// one.
/// Thread rule: ring by any thread, without waiting; wait by one thread.
class Doorbell {
 public:
  void ring() {
    rings_.fetch_add(1, std::memory_order_release);
    rings_.notify_one();
  }

  /// Returns when it was rung since the previous wait.
  void wait() {
    rings_.wait(seen_rings_, std::memory_order_acquire);
    seen_rings_ = rings_.load(std::memory_order_acquire);
  }

 private:
  std::atomic<int> rings_{0};  // the kernel waits for an int without a lock
  int seen_rings_ = 0;         // used by the waiting thread only
};

/// Queue of depth one between two threads: the newest value wins, replaced ones are counted. A
/// triple buffer: sender and receiver own one slot each and exchange it for the one between them,
/// so neither waits for the other.
/// Thread rule: put and withdraw by one thread, take and try_take by one other; the rest by any.
template <class T>
class Mailbox {
 public:
  /// Returns false when the value replaced one that was not taken.
  bool put(T value) {
    places_[sender_] = std::move(value);
    const int between = between_.exchange(sender_ | kFull, std::memory_order_acq_rel);
    sender_ = between & kPlace;
    places_[sender_].reset();
    bell_.ring();
    const bool replaced = between & kFull;
    drops_ += replaced ? 1 : 0;
    return !replaced;
  }

  /// Withdraws a value that was not taken, which counts as replaced. Called by the sender.
  void withdraw() {
    if (!(between_.load(std::memory_order_relaxed) & kFull)) return;
    const int between = between_.exchange(sender_, std::memory_order_acq_rel);
    sender_ = between & kPlace;
    drops_ += places_[sender_] ? 1 : 0;
    places_[sender_].reset();
  }

  /// Waits for a value; nullopt while the mailbox is closed; it keeps its value.
  std::optional<T> take() {
    while (!closed_) {
      if (auto value = try_take()) return value;
      bell_.wait();
    }
    return std::nullopt;
  }

  /// Takes the value, if any, without waiting.
  std::optional<T> try_take() {
    if (!(between_.load(std::memory_order_relaxed) & kFull)) return std::nullopt;
    receiver_ = between_.exchange(receiver_, std::memory_order_acq_rel) & kPlace;
    return std::exchange(places_[receiver_], std::nullopt);
  }

  /// Drops the value, which counts as replaced. Called by the receiver.
  void discard() { drops_ += try_take() ? 1 : 0; }

  /// Ends take() until open().
  void close() {
    closed_ = true;
    bell_.ring();
  }

  /// Lets take() wait again.
  void open() { closed_ = false; }

  std::uint64_t drops() const { return drops_; }

 private:
  static constexpr int kPlace = 3;
  static constexpr int kFull = 4;  ///< the value was not taken yet

  std::array<std::optional<T>, 3> places_;
  int sender_ = 0;    // slot of the sender
  int receiver_ = 1;  // slot of the receiver
  std::atomic<int> between_{2};
  Doorbell bell_;
  std::atomic<std::uint64_t> drops_{0};
  std::atomic<bool> closed_{false};
};

}  // namespace orbwatch::hal
