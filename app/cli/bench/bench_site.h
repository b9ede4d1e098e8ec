#pragma once

#include <string>
#include <vector>

#include "app/files/resolve.h"

namespace orbwatch::app {

/// For any run: the console would print into the figures.
void silence_console(Resolved& site);

/// Replaces every camera of the site by a test pattern in the format that the camera delivers,
/// which is asked where it is connected, and runs it freely. Lines become simulated ones, Modbus is
/// not served, and DDS topics get the prefix with "_bench" behind it: nobody takes the figures for
/// those of a machine. Returns for each camera how its format is known.
std::vector<std::string> simulate_cameras(Resolved& site);

}  // namespace orbwatch::app
