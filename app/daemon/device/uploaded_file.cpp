// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/device/uploaded_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::daemon {
namespace {

constexpr mode_t kOwnersFolder = 0700, kOwnersFile = 0600;

tl::unexpected<Error> upload_failure(const std::filesystem::path& path) {
  return fail(path.string() + ": " + std::generic_category().message(errno));
}

}  // namespace

Result<> make_owners_folder(const std::filesystem::path& folder) {
  if (::mkdir(folder.c_str(), kOwnersFolder) != 0 && errno != EEXIST) return upload_failure(folder);
  return {};
}

Result<std::uint64_t> add_uploaded(const std::filesystem::path& file, std::uint64_t offset,
                                   std::string_view bytes) {
  const int begins = offset == 0 ? O_CREAT | O_TRUNC : 0;
  const hal::FileDescriptor out(
      ::open(file.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC | begins, kOwnersFile));
  struct stat about {};
  if (!out.is_open() || ::fstat(out.get(), &about) != 0) {
    if (errno == ENOENT) return fail("no upload has begun; begin it at the offset 0");
    return upload_failure(file);
  }
  const auto size = static_cast<std::uint64_t>(about.st_size);
  if (size != offset) {
    return fail("offset must be " + std::to_string(size) + ", the size of what has arrived");
  }
  if (!hal::write_all(out, bytes)) {
    const auto failed = upload_failure(file);
    // The part may then be sent again; otherwise its offset is refused.
    if (::ftruncate(out.get(), about.st_size) != 0) return upload_failure(file);
    return failed;
  }
  return size + bytes.size();
}

}  // namespace orbwatch::app::daemon
