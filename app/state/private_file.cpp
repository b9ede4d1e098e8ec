#include "app/state/private_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;

constexpr off_t kMostBytes = off_t{1} << 20;
constexpr mode_t kMode = S_IRUSR | S_IWUSR;

/// With errno.
tl::unexpected<Error> cannot(const fs::path& file, const std::string& what) {
  return fail(file.string() + ": cannot be " + what + ": " + std::system_category().message(errno));
}

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// The daemon has no right to read what root owns.
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
  const hal::FileDescriptor opened(
      ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!opened.is_open() && errno == ENOENT) return std::nullopt;
  struct stat about {};
  if (!opened.is_open() || ::fstat(opened.get(), &about) != 0) return cannot(file, "read");
  if (!S_ISREG(about.st_mode)) return fail(file.string() + ": is no regular file");
  if ((about.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    return fail(file.string() + ": others than its owner may use it; mend it by chmod 600");
  }
  if (about.st_size > kMostBytes) return fail(file.string() + ": is larger than 1 MiB");
  std::string text(static_cast<std::size_t>(about.st_size), '\0');
  std::size_t length = 0;
  while (length < text.size()) {
    const ssize_t count = ::read(opened.get(), text.data() + length, text.size() - length);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return cannot(file, "read");
    if (count == 0) break;
    length += static_cast<std::size_t>(count);
  }
  text.resize(length);
  return text;
}

Result<> write_private(const fs::path& file, std::string_view text) {
  const auto folder = open_folder(file);
  if (!folder) return tl::unexpected(folder.error());
  const fs::path unfinished = file.string() + ".new";
  ::unlink(unfinished.c_str());  // of a process that was killed
  const hal::FileDescriptor written(
      ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kMode));
  const bool is_replaced = written.is_open() && give_to_owner_of(folder->get(), written.get()) &&
                           write_all(written.get(), text) && ::fsync(written.get()) == 0 &&
                           ::rename(unfinished.c_str(), file.c_str()) == 0 &&
                           ::fsync(folder->get()) == 0;
  if (!is_replaced) return cannot(file, "written");
  return {};
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
