// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/security/key_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal/regular_file.h"

namespace orbwatch::app::dds {
namespace {

tl::unexpected<Error> cannot(const std::filesystem::path& file, const char* what) {
  return fail(file.string() + ": cannot be " + what + ": " + std::strerror(errno));
}

}  // namespace

Result<> write_key_file(const std::filesystem::path& file, std::string_view text,
                        Readable readable) {
  const mode_t mode = readable == Readable::Owner ? 0600 : 0644;
  const hal::FileDescriptor out(
      ::open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode));
  if (!out.is_open() || !hal::write_all(out, text) || ::fsync(out.get()) != 0) {
    return cannot(file, "written");
  }
  return {};
}

}  // namespace orbwatch::app::dds
