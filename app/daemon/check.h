#pragma once

#include "app/config/configuration.h"

namespace orbwatch::app {

/// Finds what keeps a configuration from running although each of its files is right by itself:
/// views that the rig makes impossible, regions outside of their view, thresholds that no count
/// can reach, keys for DDS that do not work. Opens no camera and no line. Takes as long as
/// compiling all views.
Result<> check_plans(const Configuration& configuration);

}  // namespace orbwatch::app
