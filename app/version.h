// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace orbwatch::app {

/// Versions by name: the program's, and those of all device libraries, including modules'.
std::vector<std::pair<std::string, std::string>> versions(const std::string& program);

/// Text "PROGRAM 1.2.3" and a line for each device library, including modules'.
std::string version_text(const std::string& program);

}  // namespace orbwatch::app
