// SPDX-License-Identifier: Apache-2.0
#include "app/state/private_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "hal/atomic_file.h"
#include "hal/regular_file.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kMode = S_IRUSR | S_IWUSR;

/// Error with the text of errno.
tl::unexpected<Error> cannot(const fs::path& file, const std::string& what) {
  return fail(file.string() + ": cannot be " + what + ": " + std::system_category().message(errno));
}

/// Changes the owner, because the daemon may not read files of root.
bool give_to_owner_of(int folder, int file) {
  struct stat owner {};
  if (::geteuid() != 0) return true;
  return ::fstat(folder, &owner) == 0 && ::fchown(file, owner.st_uid, owner.st_gid) == 0;
}

Result<hal::FileDescriptor> open_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code error;
  fs::create_directories(folder, error);
  hal::FileDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!opened.is_open()) return cannot(folder, "opened");
  return opened;
}

}  // namespace

Result<std::optional<std::string>> read_private(const fs::path& file) {
  const hal::FileDescriptor opened = hal::open_no_link(file);
  if (!opened.is_open() && errno == ENOENT) return std::nullopt;
  if (!opened.is_open()) return cannot(file, "read");
  auto text = hal::read_regular_file(opened, file);
  if (!text) return tl::unexpected(text.error());
  struct stat about {};
  if (::fstat(opened.get(), &about) != 0) return cannot(file, "read");
  if ((about.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    return fail(file.string() +
                ": must be accessible to its owner only; set its mode to 600 by chmod");
  }
  return std::move(*text);
}

Result<> write_private(const fs::path& file, std::string_view text) {
  if (const auto folder = open_folder(file); !folder) return tl::unexpected(folder.error());
  return hal::write_file(file, text, hal::FileAccess::Owner);
}

Result<> with_lock(const fs::path& file, const std::function<Result<>()>& change) {
  const auto folder = open_folder(file);
  if (!folder) return tl::unexpected(folder.error());
  const fs::path name = file.string() + ".lock";
  const hal::FileDescriptor lock(
      ::open(name.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, kMode));
  if (!lock.is_open() || !give_to_owner_of(folder->get(), lock.get()))
    return cannot(name, "opened");
  while (::flock(lock.get(), LOCK_EX) != 0) {
    if (errno != EINTR) return cannot(name, "locked");
  }
  return change();
}

}  // namespace orbwatch::app
