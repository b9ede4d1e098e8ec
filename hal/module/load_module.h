// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "hal/module/camera_module.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Folder of the modules: the configured one, or the one that ORBWATCH_MODULES names, which a
/// program with raised privileges ignores. Thread-safe while nothing changes the environment.
std::filesystem::path module_folder();

/// File of a back-end's module, even if it does not exist.
std::filesystem::path module_file(std::string_view back_end);

/// Command that installs a back-end's package, which no repository has, from the folder of the
/// packages, and the one of a bundle. Thread-safe.
std::string install_command(std::string_view back_end);

/// Loads a module from a file and checks that it fits this program and belongs to the back-end. The
/// error names file, reason and remedy. A module that fits stays loaded, and loading it again costs
/// little; one that does not is unloaded. Thread-safe.
Result<const CameraModule*> load_module(const std::filesystem::path& file,
                                        std::string_view back_end);

/// Module of a back-end. Error: it is not installed, with the package to install; or as
/// load_module(). Thread-safe.
Result<const CameraModule*> module_of(std::string_view back_end);

}  // namespace orbwatch::hal
