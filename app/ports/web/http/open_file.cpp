// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/open_file.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "hal/regular_file.h"

namespace orbwatch::app::web {

Result<std::shared_ptr<const OpenFile>> open_file(const std::filesystem::path& path) {
  hal::FileDescriptor file = hal::open_no_link(path);
  struct stat status = {};
  if (!file.is_open() || ::fstat(file.get(), &status) != 0) {
    return fail(path.string() + ": " + std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode)) return fail(path.string() + " is not a regular file");
  return std::make_shared<const OpenFile>(
      OpenFile{std::move(file), static_cast<std::uint64_t>(status.st_size)});
}

}  // namespace orbwatch::app::web
