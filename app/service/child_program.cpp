// SPDX-License-Identifier: Apache-2.0
#include "app/service/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>

#include "hal/clock.h"
#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app {
namespace {

using hal::FileDescriptor;

constexpr int kSecret = 3;  // number in kChildSecret
constexpr std::size_t kMostErrors = std::size_t{64} << 10;

std::string system_reason(int error) { return std::generic_category().message(error); }

/// End of a wait: a moment, or a signal of another thread.
struct Limit {
  hal::TimePoint deadline;
  const hal::EventFd* cancelled;  ///< null: none
};

/// Files of a child.
struct ChildFiles {
  int output = -1;
  int errors = -1;
  int secret = -1;  ///< below 0: none
};

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Child in a process group of its own, killed and waited for at this object's end.
class Child {
 public:
  Child(const ChildCall& call, const ChildFiles& files);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { end_by({{}, nullptr}); }

  /// 0: it was started; else why not.
  int failure() const { return failure_; }

  /// Waits for its end as long as `limit` permits, then kills the rest of its group. Returns its
  /// exit status; nullopt: it did not end by itself.
  std::optional<int> end_by(const Limit& limit);

 private:
  pid_t pid_ = -1;
  int failure_ = 0;
};

Child::Child(const ChildCall& call, const ChildFiles& files) {
  std::vector<std::string> words{call.program.string()};
  words.insert(words.end(), call.arguments.begin(), call.arguments.end());
  std::vector<std::string> variables = call.environment;
  const std::vector<char*> argv = pointers_to(words), environment = pointers_to(variables);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, files.output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, files.errors, STDERR_FILENO);
  if (files.secret >= 0) posix_spawn_file_actions_adddup2(&actions, files.secret, kSecret);
  // Files that this process inherited itself are not the child's.
  posix_spawn_file_actions_addclosefrom_np(&actions, files.secret >= 0 ? kSecret + 1 : kSecret);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  failure_ = posix_spawn(&pid_, argv[0], &actions, &attributes, argv.data(), environment.data());
  if (failure_ != 0) pid_ = -1;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
}

bool wait_readable(int file, const Limit& limit) {
  std::array<pollfd, 2> waiting{
      {{file, POLLIN, 0}, {limit.cancelled ? limit.cancelled->get() : -1, POLLIN, 0}}};
  for (;;) {
    const int ready = ::poll(waiting.data(), waiting.size(), hal::poll_timeout(limit.deadline));
    if (ready > 0) return waiting[1].revents == 0;
    if (ready < 0 && errno != EINTR) return false;
    if (ready == 0 && hal::Clock::now() >= limit.deadline) return false;
  }
}

std::optional<int> Child::end_by(const Limit& limit) {
  const pid_t pid = std::exchange(pid_, -1);
  if (pid <= 0) return std::nullopt;
  // A process's descriptor is readable once it has ended (Linux 5.3).
  const FileDescriptor process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
  if (process.is_open()) wait_readable(process.get(), limit);
  // The process is not reaped yet, so that the group's number is still its own.
  siginfo_t ended{};
  ::waitid(P_PID, static_cast<id_t>(pid), &ended, WEXITED | WNOHANG | WNOWAIT);
  const bool by_itself = ended.si_pid == pid;
  ::kill(-pid, SIGKILL);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (!by_itself || !WIFEXITED(status)) return std::nullopt;
  return WEXITSTATUS(status);
}

/// Reads until the end of the file. Nullopt: too much, too late, or an error.
std::optional<std::string> read_all(int file, std::size_t most, const Limit& limit) {
  std::string text;
  std::array<char, 4096> part{};
  while (wait_readable(file, limit)) {
    const ssize_t got = ::read(file, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) return text;
    text.append(part.data(), static_cast<std::size_t>(got));
    if (text.size() > most) return std::nullopt;
  }
  return std::nullopt;
}

/// A file in memory with these bytes, at its beginning. Not open: errno has the reason.
FileDescriptor memory_file(const char* name, const std::string& bytes) {
  FileDescriptor file(::memfd_create(name, MFD_CLOEXEC));
  const bool is_written =
      file.is_open() && hal::write_all(file, bytes) && ::lseek(file.get(), 0, SEEK_SET) == 0;
  return is_written ? std::move(file) : FileDescriptor();
}

/// The beginning of a file in memory.
std::string beginning_of(const FileDescriptor& file) {
  std::string text(kMostErrors, '\0');
  const ssize_t got = ::pread(file.get(), text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return text;
}

}  // namespace

Result<ChildEnd> run_child(const ChildCall& call) {
  const std::string name = call.program.string();
  const Limit limit{hal::Clock::now() + call.time, call.cancelled};
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return fail(name + ": " + system_reason(errno));
  const FileDescriptor reading(ends[0]);
  FileDescriptor writing(ends[1]);
  const FileDescriptor errors = memory_file("errors", "");
  const FileDescriptor secret =
      call.secret.empty() ? FileDescriptor() : memory_file("secret", call.secret);
  const bool is_ready = errors.is_open() && (call.secret.empty() || secret.is_open());
  if (!is_ready) return fail(name + ": " + system_reason(errno));
  Child child(call, {writing.get(), errors.get(), secret.is_open() ? secret.get() : -1});
  if (child.failure() != 0) {
    return fail(name + " cannot be started: " + system_reason(child.failure()));
  }
  writing = FileDescriptor();  // closed, so that the child's end is the end of the file
  auto output = read_all(reading.get(), call.bytes, limit);
  if (!output) return fail(name + " printed too much or did not end in time");
  // The child may continue after it closed its output: then it is killed at the deadline.
  const auto status = child.end_by(limit);
  if (!status) return fail(name + " was ended by a signal or did not end in time");
  return ChildEnd{*status, std::move(*output), beginning_of(errors)};
}

std::vector<std::string> environment_without(const std::vector<std::string>& names) {
  std::vector<std::string> entries;
  for (char** entry = ::environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (std::ranges::count(names, text.substr(0, text.find('='))) == 0) entries.push_back(text);
  }
  return entries;
}

}  // namespace orbwatch::app
