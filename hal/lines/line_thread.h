#pragma once

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "hal/file_descriptor.h"
#include "hal/lines/line_task.h"
#include "hal/lines/watched_input.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// The one thread of all lines: hands on edges and runs tasks when they are due.
/// Thread rule: watch, add, start and stop on one thread; ring on any.
class LineThread {
 public:
  LineThread() = default;
  LineThread(const LineThread&) = delete;
  LineThread& operator=(const LineThread&) = delete;
  ~LineThread();

  /// Inputs and tasks are the caller's and outlive the run; given before start().
  void watch(WatchedInput& input) { watched_.push_back({&input, 0}); }
  void add(LineTask& task) { tasks_.push_back(&task); }

  /// Errors: no more files.
  Result<> start();
  void stop();

  /// A task's due() changed on another thread.
  void ring();

 private:
  struct Watched {
    WatchedInput* input = nullptr;
    unsigned registered = 0;  ///< opened() of the file that is polled
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
  FileDescriptor bell_;
  FileDescriptor timer_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace orbwatch::hal
