#pragma once

#include <string>
#include <utility>
#include <vector>

namespace orbwatch::app {

/// By name: the program's, and those of each device library, those of modules, too.
std::vector<std::pair<std::string, std::string>> versions(const std::string& program);

/// "PROGRAM 1.2.3" and a line for each device library, those of modules, too.
std::string version_text(const std::string& program);

}  // namespace orbwatch::app
