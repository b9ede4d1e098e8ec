#include "app/ports/dds/security/key_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app {
namespace {

tl::unexpected<Error> cannot(const std::filesystem::path& file, const char* what) {
  return fail(file.string() + ": cannot be " + what + ": " + std::strerror(errno));
}

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Result<> write_key_file(const std::filesystem::path& file, std::string_view text,
                        Readable readable) {
  const mode_t mode = readable == Readable::Owner ? 0600 : 0644;
  const hal::FileDescriptor out(
      ::open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode));
  if (!out.is_open() || !write_all(out.get(), text) || ::fsync(out.get()) != 0) {
    return cannot(file, "written");
  }
  return {};
}

}  // namespace orbwatch::app
