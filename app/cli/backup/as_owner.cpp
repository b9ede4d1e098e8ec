// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/as_owner.h"

#include <fcntl.h>
#include <grp.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>

#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::cli::backup {
namespace {

std::string reason() { return std::system_category().message(errno); }

/// The work of the other process. Its message goes to `out`; empty: done.
[[noreturn]] void act_as(const struct stat& owner, const std::function<Result<>()>& act,
                         const hal::FileDescriptor& out) {
  const bool is_owner = ::setgroups(0, nullptr) == 0 &&
                        ::setresgid(owner.st_gid, owner.st_gid, owner.st_gid) == 0 &&
                        ::setresuid(owner.st_uid, owner.st_uid, owner.st_uid) == 0;
  const auto done = is_owner ? act() : fail("cannot become the owner of recordings: " + reason());
  const bool is_told = done || hal::write_all(out, done.error().message);
  ::_exit(done && is_told ? 0 : 1);
}

std::string read_all(const hal::FileDescriptor& in) {
  std::string text;
  char part[4096];
  for (ssize_t count = 0; (count = ::read(in.get(), part, sizeof part)) > 0;) {
    text.append(part, static_cast<std::size_t>(count));
  }
  return text;
}

}  // namespace

Result<> as_owner_of(const std::filesystem::path& folder, const std::function<Result<>()>& act) {
  struct stat owner {};
  if (::stat(folder.c_str(), &owner) != 0) return fail(folder.string() + ": " + reason());
  if (::geteuid() != 0 || owner.st_uid == 0) return act();
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return fail("a pipe: " + reason());
  const hal::FileDescriptor in(ends[0]);
  hal::FileDescriptor out(ends[1]);
  const pid_t child = ::fork();
  if (child < 0) return fail("a process: " + reason());
  if (child == 0) act_as(owner, act, out);
  out = hal::FileDescriptor();
  const std::string message = read_all(in);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (status == 0) return {};
  return fail(message.empty() ? "interrupted" : message);
}

}  // namespace orbwatch::app::cli::backup
