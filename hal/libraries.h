// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace orbwatch::hal {

/// Names and versions of the linked device libraries, for `orbwatch --version`. The version of
/// libjpeg-turbo is the build's, since the library does not report it. Thread-safe.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace orbwatch::hal
