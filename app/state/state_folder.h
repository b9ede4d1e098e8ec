#pragma once

#include <filesystem>

namespace orbwatch::app {

/// Where state is kept: `configured` unless it is empty, else the first folder of systemd's
/// STATE_DIRECTORY (systemd.exec(5)), else /var/lib/orbwatch. Not while the environment is changed.
std::filesystem::path state_folder(const std::filesystem::path& configured);

}  // namespace orbwatch::app
