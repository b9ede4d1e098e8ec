// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Fate of a file that is at the place of an export.
enum class Existing { Kept, Replaced };

/// Place of a file that is written under a temporary name beside it, so that it is never visible in
/// part. Removed with the object unless it was placed. Thread-bound.
class StagedFile {
 public:
  /// Error: there is something at `target`; a folder or another special file also if it may be
  /// replaced.
  static Result<StagedFile> beside(const std::filesystem::path& target, Existing existing);

  StagedFile(StagedFile&& other) noexcept;
  StagedFile& operator=(StagedFile&&) = delete;
  ~StagedFile();

  /// Name of the file to make; there is none yet.
  const std::filesystem::path& path() const { return path_; }

  /// Gives the file its name, which survives a power cut. Errors: of the disk; there is something
  /// by now.
  Result<> place();

 private:
  StagedFile(std::filesystem::path target, Existing existing);

  std::filesystem::path target_;
  Existing existing_;
  std::filesystem::path path_;  ///< empty once it was moved
};

}  // namespace orbwatch::app::recorder
