// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "proc/image/result.h"

namespace orbwatch::app::update {

/// Trial of the running version, as the image's confirm_version states it.
struct Trial {
  std::chrono::seconds returns_in{};            ///< time until the device gives up
  std::optional<std::chrono::seconds> kept_in;  ///< nullopt: the version does not work at present
};

/// Version that was installed last and has not been kept.
struct Tried {
  std::string version;
  bool waits_for_start = false;  ///< installed since the last start, so not tried yet
};

/// Files of an image by which its parts state the result of updates: the running version, its slot,
/// its trial, and the versions that were tried. Each call reads the disk. Thread-safe.
class ImageFiles {
 public:
  /// `root`: folder of the image's root; another one in tests.
  explicit ImageFiles(std::filesystem::path root = "/") : root_(std::move(root)) {}

  /// Version of the running image; nullopt: this computer does not run one.
  std::optional<std::string> version() const;

  /// Running slot: a or b. Empty: unknown.
  std::string slot() const;

  /// True: the image has the machine builder's certificate.
  bool accepts_updates() const;

  /// nullopt: the running version is kept.
  std::optional<Trial> trial() const;

  std::optional<Tried> tried() const;

  /// Why the device returned from a version; empty: nothing wrote it.
  std::string reason_of_return(const std::string& version) const;

  /// Prepares the record that `version` is installed, which also proves that there is room for it.
  Result<> prepare_record(const std::string& version) const;
  /// Puts the prepared record in place, unless the image's keep_record has. Error: the data
  /// partition.
  Result<> keep_record() const;

 private:
  std::filesystem::path record() const;

  std::filesystem::path root_;
};

}  // namespace orbwatch::app::update
