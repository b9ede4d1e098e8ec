// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "hal/inventory.h"
#include "hal/lines/line.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli::doctor {

/// Sources of facts; tests use trees and devices of their own.
struct Sources {
  std::filesystem::path root = "/";  ///< prefix of /proc, /sys, /dev, programs and absolute paths
  std::filesystem::path boards;      ///< folder of the boards' files
  std::string architecture;          ///< value of uname -m
  /// GPIO chips that are connected.
  std::function<std::vector<hal::ChipInfo>()> chips;
  /// Cameras of a back-end that is a module. Error: the module cannot be used.
  std::function<Result<std::vector<hal::CameraEntry>>(std::string_view back_end)> module_cameras;
  /// Error: the module of videos cannot be loaded.
  std::function<Result<>()> video_module;

  /// Resolves an absolute path of the examined system.
  std::filesystem::path at(const std::filesystem::path& path) const {
    return root / path.relative_path();
  }

  /// True if an absolute path of it exists.
  bool has(const std::filesystem::path& path) const {
    std::error_code unknown;
    return std::filesystem::exists(at(path), unknown);
  }
};

/// Sources of this computer.
Sources this_computer();

}  // namespace orbwatch::app::cli::doctor
