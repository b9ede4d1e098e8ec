#pragma once

#include <string>

namespace orbwatch::app {

/// "PROGRAM 1.2.3" and a line for each device library, those of modules, too.
std::string version_text(const std::string& program);

}  // namespace orbwatch::app
