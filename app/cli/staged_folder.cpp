// SPDX-License-Identifier: Apache-2.0
#include "app/cli/staged_folder.h"

#include <fcntl.h>
#include <stdlib.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> cannot_make(const fs::path& folder, const std::string& reason) {
  return fail(folder.string() + ": cannot be made: " + reason);
}

}  // namespace

StagedFolder::StagedFolder(fs::path target, fs::path path)
    : target_(std::move(target)), path_(std::move(path)) {}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : target_(std::move(other.target_)), path_(std::exchange(other.path_, {})) {}

StagedFolder::~StagedFolder() {
  std::error_code error;
  // A folder that cannot be removed stays behind under its temporary name.
  if (!path_.empty()) fs::remove_all(path_, error);
}

Result<StagedFolder> StagedFolder::beside(const fs::path& target) {
  std::error_code error;
  fs::path place = fs::weakly_canonical(fs::absolute(target), error);
  if (!place.has_filename())
    place = place.parent_path();  // the path was given with a '/' at its end
  if (!error) fs::create_directories(place.parent_path(), error);
  if (error) return cannot_make(target, error.message());
  std::string name = (place.parent_path() / ("." + place.filename().string() + ".XXXXXX")).string();
  if (!::mkdtemp(name.data())) return cannot_make(target, std::strerror(errno));
  return StagedFolder(place, name);
}

Result<> StagedFolder::place() {
  if (::rename(path_.c_str(), target_.c_str()) != 0) {
    return cannot_make(target_, errno == ENOTEMPTY || errno == EEXIST
                                    ? "there is something in it already"
                                    : std::strerror(errno));
  }
  path_.clear();
  return {};
}

Result<> StagedFolder::replace() {
  if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) != 0) {
    return cannot_make(target_, std::strerror(errno));
  }
  std::error_code error;
  fs::remove_all(std::exchange(path_, {}), error);
  if (error)
    return fail(target_.string() + ": is new, but the old one stays beside it: " + error.message());
  return {};
}

}  // namespace orbwatch::app::cli
