// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/ptrace.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace orbwatch::tests {

/// Thread of a process by its name; 0: there is none.
inline pid_t thread_of(pid_t process, const std::string& name) {
  for (const auto& task :
       std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::ifstream in(task.path() / "comm");
    std::string found;
    if (std::getline(in, found) && found == name) return std::stoi(task.path().filename());
  }
  return 0;
}

/// Stops one thread of a child, like an endless wait in a driver, and continues it at the object's
/// end. All other threads run.
class HungThread {
 public:
  explicit HungThread(pid_t thread) : thread_(thread) {
    is_hung_ = ::ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) == 0 &&
               ::ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) == 0 &&
               ::waitpid(thread, nullptr, __WALL) == thread;
  }
  HungThread(const HungThread&) = delete;
  HungThread& operator=(const HungThread&) = delete;
  ~HungThread() { ::ptrace(PTRACE_DETACH, thread_, nullptr, nullptr); }

  bool is_hung() const { return is_hung_; }

  /// Returns when another process has ended the thread, which waits for its tracer then.
  void await_end() const {
    int status = 0;
    while (::waitpid(thread_, &status, __WALL) == thread_ && WIFSTOPPED(status)) {
    }
  }

 private:
  const pid_t thread_;
  bool is_hung_ = false;
};

}  // namespace orbwatch::tests
