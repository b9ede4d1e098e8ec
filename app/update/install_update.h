// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/update/image_files.h"
#include "app/update/installer.h"
#include "proc/image/result.h"

namespace orbwatch::app::update {

/// A bundle to be installed.
struct Update {
  std::filesystem::path bundle{};
  std::string name{};  ///< its name in messages
  /// Refuse the version that was tried last and not kept.
  bool skips_failed = false;
  /// Called with percent and step.
  std::function<void(int percent, const std::string& step)> on_progress{};
};

/// Error: why this device accepts no update at present, as a sentence. Reads the disk. Reentrant.
Result<> check_device(const ImageFiles& image);

/// Checks a bundle and writes it into the slot that does not run, which the next start tries.
/// Returns its version. Error: why it is refused or not installed, as a sentence; the running slot
/// stays as it is. Waits for RAUC.
Result<std::string> install_update(const ImageFiles& image, Installer& installer,
                                   const Update& update);

}  // namespace orbwatch::app::update
