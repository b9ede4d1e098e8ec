#pragma once

#include <string>
#include <utility>
#include <vector>

namespace orbwatch::hal {

/// Names and versions of the device libraries that are linked, for `orbwatch --version`. That of
/// libjpeg-turbo is the build's, as the library does not report it. Thread-safe.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace orbwatch::hal
