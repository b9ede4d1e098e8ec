// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace orbwatch::hal::mcap {
namespace {

int flags_of(File::Access access) {
  switch (access) {
    case File::Access::Read:
      return O_RDONLY;
    case File::Access::Change:
      return O_RDWR;
    case File::Access::Create:
      break;
  }
  return O_RDWR | O_CREAT | O_EXCL;
}

}  // namespace

FileResult<File> File::open(const std::filesystem::path& path, Access access) {
  constexpr mode_t kMode = 0640;  // pictures of a production
  File file(FileDescriptor(
                ::open(path.c_str(), flags_of(access) | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, kMode)),
            path.string());
  if (!file.descriptor_.is_open()) return file.failed_now("cannot be opened");
  struct stat status {};
  if (::fstat(file.descriptor_.get(), &status) != 0) return file.failed_now("cannot be read");
  if (!S_ISREG(status.st_mode)) return refuse(path.string() + ": must be a regular file");
  // A file system without locks is one that no second process of ours writes to.
  if (access != Access::Read && ::flock(file.descriptor_.get(), LOCK_EX | LOCK_NB) != 0 &&
      errno == EWOULDBLOCK) {
    return file.failed_now("is being written by another process");
  }
  return file;
}

FileResult<std::uint64_t> File::size() const {
  struct stat status {};
  if (::fstat(descriptor_.get(), &status) != 0) return failed_now("cannot be read");
  return static_cast<std::uint64_t>(status.st_size);
}

FileResult<> File::read(std::uint64_t offset, std::span<std::byte> into) const {
  while (!into.empty()) {
    const ssize_t count =
        ::pread(descriptor_.get(), into.data(), into.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failed_now("cannot be read at byte " + std::to_string(offset));
    if (count == 0) return refuse(name_ + ": ends at byte " + std::to_string(offset));
    offset += static_cast<std::uint64_t>(count);
    into = into.subspan(static_cast<std::size_t>(count));
  }
  return {};
}

FileResult<> File::write(std::uint64_t offset,
                         std::initializer_list<std::span<const std::byte>> parts) const {
  for (auto part : parts) {
    while (!part.empty()) {
      const ssize_t count =
          ::pwrite(descriptor_.get(), part.data(), part.size(), static_cast<off_t>(offset));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return failed_now("cannot be written at byte " + std::to_string(offset));
      offset += static_cast<std::uint64_t>(count);
      part = part.subspan(static_cast<std::size_t>(count));
    }
  }
  return {};
}

FileResult<> File::truncate(std::uint64_t size) const {
  if (::ftruncate(descriptor_.get(), static_cast<off_t>(size)) == 0) return {};
  return failed_now("cannot be truncated to " + std::to_string(size) + " bytes");
}

FileResult<> File::replace_end(std::uint64_t offset, std::span<const std::byte> bytes) const {
  if (auto done = truncate(offset); !done) return done;
  auto written = write(offset, {bytes});
  if (written) written = sync();
  if (!written) static_cast<void>(truncate(offset));  // the first error is the reason
  return written;
}

FileResult<> File::sync() const {
  if (::fdatasync(descriptor_.get()) == 0) return {};
  return failed_now("cannot be written to the disk");
}

tl::unexpected<FileError> File::named(const FileError& error) const {
  return tl::unexpected<FileError>(FileError{error.number, name_ + ": " + error.message});
}

tl::unexpected<FileError> File::failed_now(const std::string& what) const {
  const int number = errno;
  return failed(number, name_ + ": " + what);
}

}  // namespace orbwatch::hal::mcap
