// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "hal/thread/priority_mutex.h"

namespace orbwatch::hal {

/// Fixed set of buffers, lent out as shared_ptr without touching the heap: the control block of
/// each loan lies beside its buffer. The last release returns the buffer; a loan keeps the memory
/// alive after the pool's end. Thread-safe; no lock is held while a buffer is in use.
template <class T>
class BufferPool {
 public:
  using Released = std::function<void(std::size_t slot)>;

  /// Owns the buffers. `released`, if given, is called with each slot that became free, on the
  /// thread that released it; it must not block and must not throw.
  explicit BufferPool(std::vector<std::unique_ptr<T>> buffers, const Released& released = nullptr)
      : state_(std::make_shared<State>()) {
    state_->released = released;
    for (auto& buffer : buffers) {
      auto slot = std::make_unique<Slot>();
      slot->buffer = std::move(buffer);
      state_->slots.push_back(std::move(slot));
    }
  }

  /// A free buffer, or nullptr when all are lent.
  std::shared_ptr<T> acquire() {
    const std::lock_guard lock(state_->mutex);
    for (std::size_t i = 0; i < state_->slots.size(); ++i) {
      if (!state_->slots[i]->lent) return lend(i);
    }
    return nullptr;
  }

  /// The buffer of one slot, or nullptr when it is lent.
  std::shared_ptr<T> acquire(std::size_t slot) {
    const std::lock_guard lock(state_->mutex);
    return state_->slots.at(slot)->lent ? nullptr : lend(slot);
  }

  std::size_t size() const { return state_->slots.size(); }

  /// Number of buffers that are lent now.
  std::size_t lent() const {
    const std::lock_guard lock(state_->mutex);
    std::size_t count = 0;
    for (const auto& slot : state_->slots) count += slot->lent ? 1 : 0;
    return count;
  }

 private:
  struct Slot {
    std::unique_ptr<T> buffer;
    bool lent = false;
    // libstdc++ needs 16 bytes of counters plus pointer, deleter and allocator.
    alignas(std::max_align_t) std::byte control_block[128];
  };
  struct State {
    mutable PriorityMutex mutex;
    std::vector<std::unique_ptr<Slot>> slots;
    Released released;

    void release(std::size_t slot) {
      {
        const std::lock_guard lock(mutex);
        slots[slot]->lent = false;
      }
      if (released) released(slot);
    }
  };

  /// Places the control block into its slot; its deallocation is the release.
  template <class U>
  struct SlotAllocator {
    using value_type = U;
    std::shared_ptr<State> state;
    std::size_t slot;

    SlotAllocator(std::shared_ptr<State> owner, std::size_t index)
        : state(std::move(owner)), slot(index) {}
    template <class V>
    SlotAllocator(const SlotAllocator<V>& other)  // NOLINT(google-explicit-constructor): rebinding
        : state(other.state), slot(other.slot) {}

    U* allocate([[maybe_unused]] std::size_t count) {
      static_assert(sizeof(U) <= sizeof(Slot::control_block));
      assert(count == 1);
      return reinterpret_cast<U*>(state->slots[slot]->control_block);
    }
    void deallocate(U*, std::size_t) noexcept { state->release(slot); }

    template <class V>
    bool operator==(const SlotAllocator<V>& other) const {
      return state == other.state && slot == other.slot;
    }
  };
  struct KeepBuffer {
    void operator()(T*) const noexcept {}
  };

  std::shared_ptr<T> lend(std::size_t index) {
    Slot& slot = *state_->slots[index];
    slot.lent = true;
    return std::shared_ptr<T>(slot.buffer.get(), KeepBuffer{}, SlotAllocator<T>(state_, index));
  }

  std::shared_ptr<State> state_;
};

}  // namespace orbwatch::hal
