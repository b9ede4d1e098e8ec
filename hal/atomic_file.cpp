// SPDX-License-Identifier: Apache-2.0
#include "hal/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::hal {
namespace {

/// Name of a file that write_file() has not renamed yet: NAME.PROCESS-SERIAL.part
bool is_temporary(const std::filesystem::path& path) {
  constexpr std::string_view kEnd = ".part";
  const std::string name = path.filename().string();
  std::string_view rest = name;
  if (!rest.ends_with(kEnd)) return false;
  rest.remove_suffix(kEnd.size());
  for (const char before : {'-', '.'}) {
    const std::size_t digits = rest.find_last_not_of("0123456789") + 1;
    if (digits == rest.size() || digits == 0 || rest[digits - 1] != before) return false;
    rest = rest.substr(0, digits - 1);
  }
  return !rest.empty();
}

/// Some file systems have nothing to write there and return EINVAL.
bool is_synced(const std::filesystem::path& folder) {
  const FileDescriptor opened(
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return opened.is_open() && (::fsync(opened.get()) == 0 || errno == EINVAL);
}

constexpr mode_t kOwnersAlone = 0600;
constexpr mode_t kReadable = 0644;
constexpr mode_t kPermissions = 0777;

/// The error of errno.
tl::unexpected<Error> not_written(const std::filesystem::path& path) {
  return fail(path.string() + ": cannot be written: " + std::system_category().message(errno));
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

/// Transfers a file that root has made to its intended owner. False: errno has the reason.
bool give_away(const FileDescriptor& file, const struct stat& owner) {
  struct stat made {};
  if (::fstat(file.get(), &made) != 0) return false;
  const bool is_right = made.st_uid == owner.st_uid && made.st_gid == owner.st_gid;
  return is_right || ::fchown(file.get(), owner.st_uid, owner.st_gid) == 0;
}

/// Sets owner and mode of the file that is going to be `path`. False: errno has the reason.
bool set_access(const std::filesystem::path& path, FileAccess access, const FileDescriptor& file) {
  struct stat folder {};
  struct stat before {};
  if (::stat(folder_of(path).c_str(), &folder) != 0) return false;
  // A link itself is replaced, not its target, which may belong to any user.
  const bool replaces = ::lstat(path.c_str(), &before) == 0 && S_ISREG(before.st_mode);
  const bool has_owner = replaces && before.st_uid != 0;
  if (::geteuid() == 0 && !give_away(file, has_owner ? before : folder)) return false;
  if (access == FileAccess::Owner) return true;
  // A file system without modes refuses, and reports the modes that it was mounted with.
  if (replaces) {
    static_cast<void>(::fchmod(file.get(), before.st_mode & kPermissions));
  } else if (access == FileAccess::Folder) {
    static_cast<void>(::fchmod(file.get(), kOwnersAlone | (folder.st_mode & kReadable)));
  }
  return true;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path, std::filesystem::path temporary,
                       FileDescriptor file)
    : path_(std::move(path)), temporary_(std::move(temporary)), file_(std::move(file)) {}

AtomicFile::~AtomicFile() {
  if (file_.is_open()) ::unlink(temporary_.c_str());
}

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path, FileAccess access) {
  std::error_code none;
  if (std::filesystem::is_other(std::filesystem::symlink_status(path, none))) {
    return fail(path.string() + ": cannot be written: is a device or another special file");
  }
  static std::atomic<unsigned> serial{0};
  const std::string temporary =
      path.string() + "." + std::to_string(::getpid()) + "-" + std::to_string(serial++) + ".part";
  const mode_t mode = access == FileAccess::Umask ? 0666 : kOwnersAlone;
  FileDescriptor opened(::open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode));
  if (!opened.is_open()) return not_written(path);
  AtomicFile file(path, temporary, std::move(opened));
  // The lock ends with the process; while it is held, the file is not a leftover. On a file system
  // without locks, leftovers are not removed either.
  static_cast<void>(::flock(file.file_.get(), LOCK_EX));
  if (!set_access(path, access, file.file_)) return not_written(path);
  return file;
}

Result<> AtomicFile::write(std::string_view bytes) {
  if (!write_all(file_, bytes)) return not_written(path_);
  return {};
}

Result<> AtomicFile::place() {
  const bool is_placed =
      ::fsync(file_.get()) == 0 && ::rename(temporary_.c_str(), path_.c_str()) == 0;
  if (!is_placed) return not_written(path_);
  file_ = FileDescriptor();
  if (!is_synced(path_.parent_path())) return not_written(path_);
  return {};
}

Result<> write_file(const std::filesystem::path& path, std::string_view text, FileAccess access) {
  auto file = AtomicFile::create(path, access);
  if (!file) return tl::unexpected(file.error());
  return file->write(text).and_then([&] { return file->place(); });
}

Result<> write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                    FileAccess access) {
  return write_file(
      path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), access);
}

Result<> sync_folder(const std::filesystem::path& folder) {
  if (is_synced(folder)) return {};
  return fail(folder.string() + ": " + std::system_category().message(errno));
}

Result<> remove_unfinished(const std::filesystem::path& folder) {
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (!is_temporary(it->path())) continue;
    const FileDescriptor file(
        ::open(it->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (!file.is_open()) continue;  // renamed meanwhile, or not ours
    if (::flock(file.get(), LOCK_EX | LOCK_NB) == 0) std::filesystem::remove(it->path(), error);
  }
  if (error) return fail(folder.string() + ": " + error.message());
  return {};
}

}  // namespace orbwatch::hal
