// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/device/uploaded_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "app/ports/recorder/recorder_settings.h"
#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::daemon {
namespace {

constexpr mode_t kOwnersFolder = 0700, kOwnersFile = 0600;

tl::unexpected<Error> upload_failure(const std::filesystem::path& path) {
  return fail(path.string() + ": " + std::generic_category().message(errno));
}

}  // namespace

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

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

std::uint64_t backup_reserve(const RecorderSettings& recorder) {
  return recorder.folder.empty() ? BackupUpload::kSmall
                                 : static_cast<std::uint64_t>(recorder.reserve_mib) << 20;
}

BackupUpload::BackupUpload(std::filesystem::path file, std::uint64_t reserve,
                           hal::Clock::duration longest_pause)
    : file_(std::move(file)), reserve_(reserve), longest_pause_(longest_pause) {
  thread_.start("uploads", [this] { run(); });
}

/// The size of the whole is not known: each part must fit.
Result<> BackupUpload::check_room(std::uint64_t offset, std::uint64_t bytes) const {
  if (offset > kMost || bytes > kMost - offset) {
    return fail("the file is larger than " + mebibytes(kMost) +
                "; restore it by `orbwatch restore`");
  }
  if (offset + bytes <= kSmall) return {};
  std::error_code error;
  const std::filesystem::path folder = file_.parent_path();
  const std::uintmax_t free = std::filesystem::space(folder, error).available;
  if (error) return fail(folder.string() + ": " + error.message());
  if (free >= reserve_ && free - reserve_ >= bytes) return {};
  return fail("no room: the disk has " + mebibytes(free) + " left, and " + mebibytes(reserve_) +
              " must stay free; delete recordings, or restore it by `orbwatch restore`, from "
              "another disk");
}

Result<std::uint64_t> BackupUpload::add(std::uint64_t offset, std::string_view bytes) {
  if (auto room = check_room(offset, bytes.size()); !room) return tl::unexpected(room.error());
  const std::lock_guard lock(mutex_);
  auto size = add_uploaded(file_, offset, bytes);
  keep_locked();  // also after an error: a file may have begun
  return size;
}

void BackupUpload::keep() {
  const std::lock_guard lock(mutex_);
  keep_locked();
}

void BackupUpload::keep_locked() {
  abandoned_ = hal::Clock::now() + longest_pause_;
  thread_.wake();
}

/// Body of the thread.
void BackupUpload::run() {
  hal::TimePoint wakes = hal::TimePoint::max();
  while (thread_.wait_until(wakes)) {
    const std::lock_guard lock(mutex_);
    if (hal::Clock::now() >= abandoned_) {
      std::error_code none;  // a file that stays is removed at the next start
      std::filesystem::remove(file_, none);
      abandoned_ = hal::TimePoint::max();
    }
    wakes = abandoned_;
  }
}

}  // namespace orbwatch::app::daemon
