// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace orbwatch::app::cli {

/// Load of a thread of this process.
struct ThreadLoad {
  int id = 0;
  std::string name;
  std::chrono::nanoseconds time{0};  ///< processor time since its start

  bool operator==(const ThreadLoad&) const = default;
};

/// The threads of this process, in the order of their start; times in steps of 10 ms. `proc` is the
/// mount point of procfs. Reentrant.
std::vector<ThreadLoad> thread_loads(const std::filesystem::path& proc = "/proc");

/// The part of `after` that is not in `before`.
std::vector<ThreadLoad> since(const std::vector<ThreadLoad>& before, std::vector<ThreadLoad> after);

/// Memory of this process, MiB; NaN if the kernel does not report it.
struct MemoryFigures {
  double resident = 0;
  double peak = 0;       ///< largest resident size so far
  double anonymous = 0;  ///< resident size: views, mip levels, grids, buffers of own memory
  double file = 0;       ///< resident size: programs and libraries
  double shared = 0;     ///< resident size: buffers of drivers and heaps, shared memory of DDS
  double locked = 0;     ///< size mapped for locking, used or not
};

MemoryFigures memory_figures(const std::filesystem::path& proc = "/proc");

}  // namespace orbwatch::app::cli
