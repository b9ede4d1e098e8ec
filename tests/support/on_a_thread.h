#pragma once

#include <exception>
#include <functional>
#include <thread>

namespace orbwatch::tests {

/// Does `work` on a thread of its own, which takes what it did to itself along when it ends. Throws
/// what `work` threw.
inline void on_a_thread(const std::function<void()>& work) {
  std::exception_ptr thrown;
  std::thread([&] {
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
  }).join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace orbwatch::tests
