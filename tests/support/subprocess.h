// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace orbwatch::tests {

/// A program that runs beside the test, with both output streams in a file. Killed at this object's
/// end.
class Subprocess {
 public:
  Subprocess(std::vector<std::string> arguments, const std::filesystem::path& output)
      : output_(output) {
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    const int error = posix_spawn(&pid_, argv[0], &files, nullptr, argv.data(), environ);
    EXPECT_EQ(error, 0) << "cannot run " << arguments[0];
    if (error != 0) pid_ = 0;
    posix_spawn_file_actions_destroy(&files);
  }
  Subprocess(const Subprocess&) = delete;
  Subprocess& operator=(const Subprocess&) = delete;
  ~Subprocess() {
    send(SIGKILL);
    wait();
  }

  void send(int signal) const {
    if (pid_ > 0) kill(pid_, signal);
  }

  pid_t pid() const { return pid_; }

  bool runs() {
    if (pid_ > 0 && waitpid(pid_, &status_, WNOHANG) == pid_) pid_ = 0;
    return pid_ > 0;
  }

  /// Waits for its end; returns the exit code, or minus the signal that ended it.
  int wait() {
    if (pid_ > 0) waitpid(pid_, &status_, 0);
    pid_ = 0;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
  }

  std::string output() const {
    std::ifstream in(output_);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

 private:
  std::filesystem::path output_;
  pid_t pid_ = 0;
  int status_ = 0;
};

}  // namespace orbwatch::tests
