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

#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::hal {
namespace {

/// Of a file that write_file() has not renamed yet: NAME.PROCESS-SERIAL.part
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

/// Some file systems have nothing to write there, and say EINVAL.
bool is_synced(const std::filesystem::path& folder) {
  const FileDescriptor opened(
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return opened.is_open() && (::fsync(opened.get()) == 0 || errno == EINVAL);
}

/// Whoever could read or write the file before, still can.
void keep_mode(const std::filesystem::path& path, const FileDescriptor& file) {
  constexpr mode_t kPermissions = 0777;
  struct stat before {};
  if (!file.is_open() || ::stat(path.c_str(), &before) != 0) return;
  static_cast<void>(::fchmod(file.get(), before.st_mode & kPermissions));
}

}  // namespace

Result<> write_file(const std::filesystem::path& path, std::string_view text) {
  static std::atomic<unsigned> serial{0};
  const std::string temporary =
      path.string() + "." + std::to_string(::getpid()) + "-" + std::to_string(serial++) + ".part";
  const FileDescriptor file(
      ::open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
  // The lock, which ends with the process, says that the file is no leftover. Where a file system
  // has no locks, leftovers are not removed either.
  if (file.is_open()) static_cast<void>(::flock(file.get(), LOCK_EX));
  keep_mode(path, file);
  const bool is_replaced = file.is_open() && write_all(file, text) && ::fsync(file.get()) == 0 &&
                           ::rename(temporary.c_str(), path.c_str()) == 0;
  if (is_replaced && is_synced(path.parent_path())) return {};
  const std::string reason = std::system_category().message(errno);
  if (file.is_open() && !is_replaced) ::unlink(temporary.c_str());
  return fail(path.string() + ": cannot be written: " + reason);
}

Result<> write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  return write_file(path,
                    std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
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
