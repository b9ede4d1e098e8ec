// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "app/ports/recorder/export/export_file.h"
#include "app/ports/recorder/export/export_steps.h"
#include "hal/mcap/fields.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Writes a ZIP archive of files, stored: recordings and JPEG are compressed already. Thread-bound;
/// waits for the disk.
class ZipWriter {
 public:
  /// `now`: time of all files in the archive, UTC, from 1980 on.
  static Result<ZipWriter> create(const std::filesystem::path& path, std::chrono::sys_seconds now);

  /// Appends a file as `name`, UTF-8. Errors: of the disk; the archive would exceed 4 GiB;
  /// cancelled.
  Result<> add(const std::string& name, const std::filesystem::path& file,
               const ExportSteps& steps);
  /// Writes the list of files, and makes the archive survive a power cut.
  Result<> finish();

 private:
  ZipWriter(ExportFile file, std::chrono::sys_seconds now) : file_(std::move(file)), now_(now) {}

  ExportFile file_;
  std::chrono::sys_seconds now_;
  hal::mcap::Bytes list_;  ///< of the files
  std::uint16_t files_ = 0;
};

}  // namespace orbwatch::app::recorder
