// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// Folder that is filled under a temporary name beside its place and moved there when it is
/// complete, so that it is never visible in part. Removed with the object unless it was moved.
/// Thread-bound.
class StagedFolder {
 public:
  /// Creates it for the folder `target`, whose parents are created if missing. Accessible to its
  /// owner only. Error: names folder and reason.
  static Result<StagedFolder> beside(const std::filesystem::path& target);

  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder& operator=(StagedFolder&&) = delete;
  ~StagedFolder();

  /// Folder to write into.
  const std::filesystem::path& path() const { return path_; }

  /// Moves it to its place. Error: the place is occupied, other than by an empty folder.
  Result<> place();
  /// Moves it and replaces an existing folder atomically.
  Result<> replace();

 private:
  StagedFolder(std::filesystem::path target, std::filesystem::path path);

  std::filesystem::path target_;
  std::filesystem::path path_;  ///< empty once it was moved
};

}  // namespace orbwatch::app::cli
