#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace orbwatch {

/// Leaves new elements as the memory is: what is never written to never becomes resident.
template <class T>
struct UntouchedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UntouchedAllocator<U>;
  };

  UntouchedAllocator() = default;
  template <class U>
  // NOLINTNEXTLINE(google-explicit-constructor): rebinding
  UntouchedAllocator(const UntouchedAllocator<U>&) noexcept {}

  /// Allocation makes such elements, whatever they are.
  template <class U>
  void construct(U*) noexcept {
    static_assert(std::is_trivially_copyable_v<U>);
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

/// Elements of resize() are not initialised, not even by their own initialisers.
template <class T>
using UntouchedVector = std::vector<T, UntouchedAllocator<T>>;

}  // namespace orbwatch
