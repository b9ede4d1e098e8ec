#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace orbwatch::app::simulation {

/// Calls `work` with every number from 0 to below `count`, on all cores; returns when all is done.
/// For configuration only. `work` must be reentrant and not throw.
inline void parallel_for(int count, const std::function<void(int)>& work) {
  std::atomic<int> next{0};
  const auto take_turns = [&] {
    for (int i = next++; i < count; i = next++) work(i);
  };
  const int others =
      std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, count) - 1;
  std::vector<std::jthread> threads;
  threads.reserve(static_cast<std::size_t>(others));
  for (int i = 0; i < others; ++i) threads.emplace_back(take_turns);
  take_turns();
}

}  // namespace orbwatch::app::simulation
