#pragma once

#include <filesystem>

#include "proc/image/result.h"

namespace orbwatch::app {

/// A folder that is filled under another name beside its place and moved there when it is whole, so
/// that nobody ever sees a part of it. Gone with the object unless it was moved. Thread-bound.
class StagedFolder {
 public:
  /// For the folder `target`; what that stands in is made if missing. The folder is its owner's
  /// only. Error: names folder and reason.
  static Result<StagedFolder> beside(const std::filesystem::path& target);

  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder& operator=(StagedFolder&&) = delete;
  ~StagedFolder();

  /// Where to write.
  const std::filesystem::path& path() const { return path_; }

  /// Moves it to its place. Error: something is there, other than an empty folder.
  Result<> place();
  /// The same, and removes what is there. At every moment the one or the other is in its place.
  Result<> replace();

 private:
  StagedFolder(std::filesystem::path target, std::filesystem::path path);

  std::filesystem::path target_;
  std::filesystem::path path_;  ///< empty when it was moved
};

}  // namespace orbwatch::app
