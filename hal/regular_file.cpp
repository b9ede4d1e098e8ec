// SPDX-License-Identifier: Apache-2.0
#include "hal/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace orbwatch::hal {
namespace {

tl::unexpected<Error> not_read(const std::filesystem::path& file, const std::string& reason) {
  return fail(file.string() + ": cannot be read: " + reason);
}

std::string system_reason() { return std::generic_category().message(errno); }

}  // namespace

Result<std::string> read_regular_file(const std::filesystem::path& file, std::size_t most) {
  // Without O_NONBLOCK, opening a pipe would already block.
  const FileDescriptor in(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!in.is_open()) return not_read(file, system_reason());
  return read_regular_file(in, file, most);
}

Result<std::string> read_regular_file(const FileDescriptor& opened,
                                      const std::filesystem::path& file, std::size_t most) {
  struct stat about {};
  if (::fstat(opened.get(), &about) != 0) return not_read(file, system_reason());
  if (S_ISDIR(about.st_mode)) return not_read(file, "Is a directory");
  if (!S_ISREG(about.st_mode)) return not_read(file, "is a pipe or a device, not a regular file");
  std::string text;
  constexpr std::size_t kBlock = 16384;
  for (std::size_t size = 0; size <= most;) {
    text.resize(std::min(size + kBlock, most + 1));
    const ssize_t count = ::read(opened.get(), text.data() + size, text.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return not_read(file, system_reason());
    size += static_cast<std::size_t>(count);
    text.resize(size);
    if (count == 0) return text;
  }
  return not_read(file, "is larger than " + std::to_string(most >> 10) + " KiB");
}

FileDescriptor open_no_link(const std::filesystem::path& file) {
  return FileDescriptor(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
}

bool write_all(const FileDescriptor& file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file.get(), text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace orbwatch::hal
