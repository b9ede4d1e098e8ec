// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/staged_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "hal/atomic_file.h"

namespace orbwatch::app::recorder {
namespace {

tl::unexpected<Error> occupied(const std::filesystem::path& target) {
  return fail(target.string() + ": there is a file already; name another one, or say --force");
}

/// A name that hal::remove_unfinished() knows.
std::filesystem::path temporary_beside(const std::filesystem::path& target) {
  static std::atomic<unsigned> serial{0};
  return target.string() + "." + std::to_string(::getpid()) + "-" + std::to_string(serial++) +
         ".part";
}

/// Renames unless there is something. Some file systems, such as exFAT and NFS, cannot do both in
/// one step: a file that appears in between is replaced there.
bool rename_to_free(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL) return false;
  std::error_code none;
  if (std::filesystem::exists(std::filesystem::symlink_status(to, none))) {
    errno = EEXIST;
    return false;
  }
  return ::rename(from.c_str(), to.c_str()) == 0;
}

}  // namespace

StagedFile::StagedFile(std::filesystem::path target, Existing existing)
    : target_(std::move(target)), existing_(existing), path_(temporary_beside(target_)) {}

StagedFile::StagedFile(StagedFile&& other) noexcept
    : target_(std::move(other.target_)),
      existing_(other.existing_),
      path_(std::exchange(other.path_, {})) {}

StagedFile::~StagedFile() {
  std::error_code error;
  // A file that cannot be removed stays behind under its temporary name.
  if (!path_.empty()) std::filesystem::remove(path_, error);
}

Result<StagedFile> StagedFile::beside(const std::filesystem::path& target, Existing existing) {
  std::error_code none;
  const auto status = std::filesystem::symlink_status(target, none);
  if (!std::filesystem::exists(status)) return StagedFile(target, existing);
  if (existing == Existing::Kept) return occupied(target);
  if (std::filesystem::is_regular_file(status)) return StagedFile(target, existing);
  return fail(target.string() + ": must be a regular file to be replaced");
}

Result<> StagedFile::place() {
  const bool is_placed = existing_ == Existing::Replaced
                             ? ::rename(path_.c_str(), target_.c_str()) == 0
                             : rename_to_free(path_, target_);
  if (!is_placed && errno == EEXIST) return occupied(target_);
  if (!is_placed) {
    return fail(target_.string() + ": cannot be written: " + std::system_category().message(errno));
  }
  path_.clear();
  return hal::sync_folder(target_.parent_path());
}

}  // namespace orbwatch::app::recorder
