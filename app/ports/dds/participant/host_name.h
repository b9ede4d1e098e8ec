#pragma once

#include <string>

namespace orbwatch::app {

/// Of this computer; empty when the system does not know it. Thread-safe.
std::string host_name();

}  // namespace orbwatch::app
