// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/files/resolve.h"

namespace orbwatch::app::cli {

/// Disables the console for any run, since it would print into the figures.
void silence_console(files::Resolved& site);

/// Replaces every camera of the site by a test pattern in the format that the camera delivers,
/// queried if it is connected, and runs it freely. Lines become simulated ones, Modbus is not
/// served, and DDS topics get the prefix followed by "_bench", so that the figures cannot be
/// mistaken for those of a machine. Returns for each camera the source of its format.
std::vector<std::string> simulate_cameras(files::Resolved& site);

}  // namespace orbwatch::app::cli
