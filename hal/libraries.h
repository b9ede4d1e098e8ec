#pragma once

#include <string>
#include <utility>
#include <vector>

namespace orbwatch::hal {

/// Names and versions of the device libraries this program talks to, for `orbwatch --version`.
/// libcamera and libgpiod answer themselves; libjpeg-turbo cannot, so its is that of the build.
/// Thread-safe.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace orbwatch::hal
