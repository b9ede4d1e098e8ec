// SPDX-License-Identifier: Apache-2.0
#include "hal/made_folder.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "hal/atomic_file.h"
#include "hal/thread/file_descriptor.h"
#include "hal/thread/thread.h"

namespace orbwatch::hal {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kAllBits = 07777;
constexpr mode_t kPlainModes = 0777;  // without set-user-ID, set-group-ID and sticky bits

tl::unexpected<Error> not_made(const fs::path& folder, const std::string& what) {
  return fail(folder.string() + ": cannot be " + what + ": " +
              std::system_category().message(errno));
}

/// Makes a folder with this mode whatever the umask, by a thread with an umask of its own: that of
/// the process would count for files that others make meanwhile. A later chmod is not enough,
/// because the kernel passes the set-group-ID bit on, which the service may not set. Returns errno.
int make_with_mode(const fs::path& folder, mode_t mode) {
  int error = 0;
  Thread thread;
  thread.start("make folder", [&] {
    if (::unshare(CLONE_FS) == 0) ::umask(0);
    if (::mkdir(folder.c_str(), mode) != 0) error = errno;
  });
  thread.stop();
  return error;
}

}  // namespace

Result<> make_folder(const fs::path& folder) {
  struct stat above {};
  if (::stat(folder.parent_path().c_str(), &above) != 0) return not_made(folder, "made");
  errno = make_with_mode(folder, above.st_mode & kPlainModes);
  if (errno != 0) return not_made(folder, "made");
  // A user who may write above could put a link in its place meanwhile.
  const FileDescriptor opened(
      ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat about {};
  const bool is_ours =
      opened.is_open() && ::fstat(opened.get(), &about) == 0 && about.st_uid == ::geteuid();
  const bool is_given =
      is_ours && (::geteuid() != 0 || ::fchown(opened.get(), above.st_uid, above.st_gid) == 0);
  const mode_t mode = above.st_mode & (kPlainModes | S_ISGID);
  const bool is_right = is_given && (about.st_mode & kAllBits) == mode;
  if (!is_given || (!is_right && ::fchmod(opened.get(), mode) != 0)) {
    return not_made(folder, "given its owner");
  }
  return sync_folder(folder.parent_path());
}

Result<> make_folders_above(const fs::path& file) {
  const fs::path folder = file.parent_path();
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return {};
  return make_folders_above(folder).and_then([&] { return make_folder(folder); });
}

}  // namespace orbwatch::hal
