// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "hal/lines/line_task.h"
#include "hal/lines/watched_input.h"
#include "hal/thread/file_descriptor.h"
#include "hal/thread/thread.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Thread of lines and of timed tasks: forwards edges and runs tasks when they are due. All lines
/// share one; a task that may wait for a device has one of its own.
/// Thread rule: watch, add, start and stop on one thread; wake on any.
class LineThread {
 public:
  /// Inputs and tasks belong to the caller and outlive the run; added before start().
  void watch(WatchedInput& input) { watched_.push_back({&input, 0}); }
  void add(LineTask& task) { tasks_.push_back(&task); }

  /// `name` is the thread's. Error: too many open files.
  Result<> start(std::string_view name = "lines");
  void stop() { thread_.stop(); }

  bool has_work() const { return !watched_.empty() || !tasks_.empty(); }

  /// Call when a task's due() changed on another thread.
  void wake() { woken_.signal(); }

 private:
  struct Watched {
    WatchedInput* input = nullptr;
    unsigned registered = 0;  ///< opened() of the polled file
  };

  void run();
  void poll_open_files();
  void set_timer();
  TimePoint next_due() const;
  void run_due();
  void wait();

  std::vector<Watched> watched_;
  std::vector<LineTask*> tasks_;
  FileDescriptor poll_;
  EventFd woken_;
  FileDescriptor timer_;
  Thread thread_;
};

}  // namespace orbwatch::hal
