#pragma once

#include <string>

namespace orbwatch::app {

/// "PROGRAM 1.2.3" and a line with the device libraries it talks to.
std::string version_text(const std::string& program);

}  // namespace orbwatch::app
