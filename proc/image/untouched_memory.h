// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace orbwatch {

/// Allocator that leaves new elements uninitialised: pages that are never written to never become
/// resident.
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

  /// Default-constructs an uninitialised element.
  template <class U>
  void construct(U*) noexcept {
    static_assert(std::is_trivially_copyable_v<U>);
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

/// A vector whose resize() leaves elements uninitialised, even those with initialisers of their
/// own.
template <class T>
using UntouchedVector = std::vector<T, UntouchedAllocator<T>>;

/// Makes room for `size` elements, which lose their values if there was less.
template <class T>
void make_room(UntouchedVector<T>& elements, std::size_t size) {
  if (elements.size() < size) elements = UntouchedVector<T>(size);
}

}  // namespace orbwatch
