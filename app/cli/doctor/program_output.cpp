// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/program_output.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "hal/clock.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::cli::doctor {
namespace {

using hal::FileDescriptor;

/// Child in a process group of its own, killed and waited for at this object's end.
class Child {
 public:
  Child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
        int output);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { end_by({}); }

  bool is_started() const { return pid_ > 0; }

  /// Waits for its end until the deadline, then kills the rest of its group. Returns true if it
  /// ended by itself, with status 0.
  bool end_by(hal::TimePoint deadline);

 private:
  pid_t pid_ = -1;
};

Child::Child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
             int output) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::string language = "LC_ALL=C", path = "PATH=/usr/sbin:/usr/bin:/sbin:/bin";
  std::array<char*, 3> environment{language.data(), path.data(), nullptr};

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  if (posix_spawn(&pid_, argv[0], &files, &attributes, argv.data(), environment.data()) != 0) {
    pid_ = -1;
  }
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
}

bool wait_readable(int file, hal::TimePoint deadline) {
  pollfd waiting{file, POLLIN, 0};
  for (;;) {
    const int ready = ::poll(&waiting, 1, hal::poll_timeout(deadline));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
    if (ready == 0 && hal::Clock::now() >= deadline) return false;
  }
}

bool Child::end_by(hal::TimePoint deadline) {
  const pid_t pid = std::exchange(pid_, -1);
  if (pid <= 0) return false;
  // A process's descriptor is readable once it has ended (Linux 5.3).
  const FileDescriptor process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
  if (process.is_open()) wait_readable(process.get(), deadline);
  // The process is not reaped yet, so that the group's number is still its own.
  siginfo_t ended{};
  ::waitid(P_PID, static_cast<id_t>(pid), &ended, WEXITED | WNOHANG | WNOWAIT);
  const bool by_itself = ended.si_pid == pid;
  ::kill(-pid, SIGKILL);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return by_itself && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Reads until the end of the file. Nullopt: too much, too late, or an error.
std::optional<std::string> read_all(int file, std::size_t most, hal::TimePoint deadline) {
  std::string text;
  std::array<char, 4096> part{};
  while (wait_readable(file, deadline)) {
    const ssize_t got = ::read(file, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) return text;
    text.append(part.data(), static_cast<std::size_t>(got));
    if (text.size() > most) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> program_output(const std::filesystem::path& program,
                                          const std::vector<std::string>& arguments,
                                          const ProgramLimits& limits) {
  const auto deadline = hal::Clock::now() + limits.time;
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  const FileDescriptor reading(ends[0]);
  FileDescriptor writing(ends[1]);
  Child child(program, arguments, writing.get());
  if (!child.is_started()) return std::nullopt;
  writing = FileDescriptor();  // closed, so that the child's end is the end of the file
  auto text = read_all(reading.get(), limits.bytes, deadline);
  if (!text) return std::nullopt;
  // The child may continue after it closed its output: then it is killed at the deadline.
  return child.end_by(deadline) ? text : std::nullopt;
}

}  // namespace orbwatch::app::cli::doctor
