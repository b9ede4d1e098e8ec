// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "hal/thread/thread.h"

namespace orbwatch::app::simulation {

/// Calls `work` with 0 to `count` - 1 on all cores and waits for the end. For configuration only.
/// `work` must be reentrant and not throw.
inline void parallel_for(int count, const std::function<void(int)>& work) {
  std::atomic<int> next{0};
  const auto take_turns = [&] {
    for (int i = next++; i < count; i = next++) work(i);
  };
  const int others =
      std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, count) - 1;
  std::vector<hal::Thread> threads(static_cast<std::size_t>(others));
  for (hal::Thread& thread : threads) thread.start("simulation", take_turns);
  take_turns();
}

}  // namespace orbwatch::app::simulation
